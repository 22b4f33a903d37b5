#include "validation/opengl/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>

#include "fathom/failures/errors.h"

namespace fathom::validation {

/// A private X display that nobody looks at: an Xvfb started here. While this object lives, DISPLAY
/// names it. It ends with this object, and with the thread that made it, however that ends.
///
/// Needs  a process that has started no threads.
class VirtualDisplay {
 public:
  /// Fails    InputError if Xvfb is not installed or does not start.
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

 private:
  pid_t server_ = -1;
  std::string before_;  ///< what DISPLAY was
};

namespace {

constexpr int milliseconds_to_start = 30000;
/// Where Xvfb writes the number of its display.
constexpr int number_file = 3;

/// Xvfb in place of this process. It gets SIGTERM, at which it takes its lock and socket away, when
/// `parent` ends; a group of its own keeps it from being killed together with that.
[[noreturn]] void become_server(int pipe, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);  // it ended before that
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  if (pipe == number_file) {
    ::fcntl(pipe, F_SETFD, 0);
  } else {
    ::dup2(pipe, number_file);
  }
  ::close_range(number_file + 1, ~0U, 0);  // what others wait for the end of
  ::execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "64x64x24", "-nolisten", "tcp",
           "-noreset", nullptr);
  ::_exit(127);
}

/// The line that comes through `pipe`; empty where none does.
std::string line_of(int pipe) {
  std::string line;
  for (char c = 0;;) {
    pollfd waiting{pipe, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, milliseconds_to_start);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0 || ::read(pipe, &c, 1) != 1) return "";
    if (c == '\n') return line;
    line += c;
  }
}

void end(pid_t server) {
  ::kill(server, SIGTERM);
  while (::waitpid(server, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

VirtualDisplay::VirtualDisplay() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw InputError("Xvfb: cannot be started");
  const pid_t parent = ::getpid();
  server_ = ::fork();
  if (server_ == 0) become_server(ends[1], parent);
  ::close(ends[1]);
  const std::string number = server_ > 0 ? line_of(ends[0]) : "";
  ::close(ends[0]);
  if (number.empty()) {
    if (server_ > 0) end(server_);
    throw InputError("Xvfb: does not start; the package xvfb provides it");
  }
  const char* const display = std::getenv("DISPLAY");
  before_ = display != nullptr ? display : "";
  ::setenv("DISPLAY", (":" + number).c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
  end(server_);
  if (before_.empty()) {
    ::unsetenv("DISPLAY");
  } else {
    ::setenv("DISPLAY", before_.c_str(), 1);
  }
}

namespace {

[[noreturn]] void fail(const std::string& step) {
  throw InputError("OpenGL without a display: " + step +
                   " failed; the packages libegl1 and libgl1-mesa-dri provide it");
}

void* platform_display(EGLenum platform) {
  const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (get_display == nullptr) fail("finding eglGetPlatformDisplayEXT");
  void* const display = get_display(platform, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY) fail("eglGetPlatformDisplayEXT");
  return display;
}

EGLConfig chosen_config(void* display) {
  const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE,
                                     EGL_PBUFFER_BIT,  // not the default, a window
                                     EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, wanted.data(), &config, 1, &count) == EGL_FALSE || count < 1) {
    fail("eglChooseConfig");
  }
  return config;
}

bool is_xvfb_demanded() {
  const char* const value = std::getenv("FATHOM_OPENGL_DISPLAY");
  return value != nullptr && std::string_view(value) == "xvfb";
}

/// Whether some driver draws on X displays at all.
bool has_x_platform() {
  const char* const extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  return extensions != nullptr &&
         std::string_view(extensions).find("platform_x11") != std::string_view::npos;
}

// libGL itself is not linked.
constexpr unsigned gl_renderer = 0x1F01, gl_version = 0x1F02;

/// glGetString in the context that is current.
std::string text_of(unsigned name) {
  using GetString = const unsigned char* (*)(unsigned);
  const auto get_string = reinterpret_cast<GetString>(eglGetProcAddress("glGetString"));
  const unsigned char* const value = get_string != nullptr ? get_string(name) : nullptr;
  return value != nullptr ? reinterpret_cast<const char*>(value) : "unknown";
}

}  // namespace

// A driver that Mesa takes from another variable, or that is not Mesa's, has its own line here.
void demand(Driver driver) {
  if (driver == Driver::usual) return;
  ::setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
  ::setenv("GALLIUM_DRIVER", name_of(driver).c_str(), 1);
  ::setenv("EGL_LOG_LEVEL", "fatal", 0);  // that it is missing is said in our words
}

void require(Driver driver, const std::string& gl_renderer) {
  // "softpipe", "llvmpipe (LLVM 15.0.6, 256 bits)"
  if (driver == Driver::usual || gl_renderer.starts_with(name_of(driver))) return;
  throw InputError(name_of(driver) + ": OpenGL has no such driver here" +
                   (gl_renderer.empty() ? "" : " and draws with " + gl_renderer) +
                   "; a Mesa that is built with it provides it (Debian's libgl1-mesa-dri is)");
}

EglContext::EglContext(Driver driver) {
  demand(driver);
  try {
    open_somehow();
  } catch (const InputError&) {
    require(driver, "");
    throw;
  }
  try {
    require(driver, text_of(gl_renderer));
  } catch (const InputError&) {
    close();
    throw;
  }
}

EglContext::~EglContext() {
  close();
}

/// Without a display where the driver allows it, else on an Xvfb.
void EglContext::open_somehow() {
  std::string failure;
  try {
    if (is_xvfb_demanded()) fail("an Xvfb, which FATHOM_OPENGL_DISPLAY demands,");
    open(EGL_PLATFORM_SURFACELESS_MESA);
    return;
  } catch (const InputError& error) {
    failure = error.what();
  }
  if (!has_x_platform()) throw InputError(failure);
  try {
    virtual_display_ = std::make_unique<VirtualDisplay>();
    open(EGL_PLATFORM_X11_EXT);
  } catch (const InputError&) {
    throw InputError(failure);  // what a display would have made unnecessary
  }
}

/// Opens display and context and makes them current, or leaves nothing open.
void EglContext::open(unsigned platform) {
  display_ = platform_display(platform);
  try {
    if (eglInitialize(display_, nullptr, nullptr) == EGL_FALSE) fail("eglInitialize");
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) fail("eglBindAPI");
    EGLConfig const config = chosen_config(display_);
    // A compatible context where there is one, as VTK's own windows make it.
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, nullptr);
    if (context_ == EGL_NO_CONTEXT) fail("eglCreateContext");
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE) return;
    // Not without a surface: one that is never drawn on.
    const std::array<EGLint, 5> size{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    surface_ = eglCreatePbufferSurface(display_, config, size.data());
    make_current();
  } catch (const InputError&) {
    close();
    throw;
  }
}

void EglContext::close() {
  if (context_ != nullptr) {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface_ != nullptr) eglDestroySurface(display_, surface_);
    eglDestroyContext(display_, context_);
  }
  if (display_ != nullptr) eglTerminate(display_);
  display_ = context_ = surface_ = nullptr;
}

std::string EglContext::way() const {
  return virtual_display_ ? ", on Xvfb" : "";
}

std::string EglContext::description() const {
  return text_of(gl_renderer) + ", " + text_of(gl_version) + way();
}

void EglContext::make_current() const {
  if (eglMakeCurrent(display_, surface_, surface_, context_) == EGL_FALSE) fail("eglMakeCurrent");
}

}  // namespace fathom::validation
