# Writes text files into a C++ source file: a std::string_view for each, named after it.
#   cmake -DHEADER=apps/validate/report/page.h -DNAMESPACE=fathom::validation::page
#         "-DFILES=style.css;body.html" -DOUTPUT=page.cpp -P EmbedTexts.cmake
cmake_minimum_required(VERSION 3.22)
# Texts are longer than C++ asks of every compiler, and no longer than those take that are used.
set(source "#pragma GCC diagnostic push\n#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n")
string(APPEND source "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME_WE)
  file(READ "${file}" text)
  string(APPEND source "\nconst std::string_view ${name} = R\"text(${text})text\";\n")
endforeach()
file(WRITE "${OUTPUT}" "${source}\n}  // namespace ${NAMESPACE}\n#pragma GCC diagnostic pop\n")
