# Debian builds cpp-httplib as a library and ships no package config: CppHttplib::CppHttplib from its header and library.
# The definitions are those of cpp-httplib.pc: types of the header differ without them.
find_path(CPP_HTTPLIB_INCLUDE_DIR httplib.h)
find_library(CPP_HTTPLIB_LIBRARY cpp-httplib)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CppHttplib REQUIRED_VARS CPP_HTTPLIB_LIBRARY CPP_HTTPLIB_INCLUDE_DIR)
if(CppHttplib_FOUND AND NOT TARGET CppHttplib::CppHttplib)
  add_library(CppHttplib::CppHttplib UNKNOWN IMPORTED)
  set_target_properties(CppHttplib::CppHttplib PROPERTIES
    IMPORTED_LOCATION "${CPP_HTTPLIB_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${CPP_HTTPLIB_INCLUDE_DIR}"
    INTERFACE_COMPILE_DEFINITIONS "CPPHTTPLIB_OPENSSL_SUPPORT;CPPHTTPLIB_ZLIB_SUPPORT;CPPHTTPLIB_BROTLI_SUPPORT")
endif()
mark_as_advanced(CPP_HTTPLIB_INCLUDE_DIR CPP_HTTPLIB_LIBRARY)
