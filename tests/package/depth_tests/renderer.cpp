// A renderer as small as one can be, in another project: it draws scene.obj as camera.json sees it
// by casting a ray through the middle of each pixel, in binary32, and writes a PFM. What it can do
// wrong, the tests ask for by name.
//   renderer MAP [FAULT]
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <thread>

namespace {

constexpr int width = 64, height = 48;
constexpr float focal = 60, centre_x = 32, centre_y = 24;

struct Vector {
  float x, y, z;
};
Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
float dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// scene.obj: the camera is at the origin and looks along z, y down.
constexpr std::array<Vector, 4> corners{
    {{-1.1F, -1, 3}, {1.3F, -0.9F, 4}, {1.2F, 1, 4}, {-1, 0.8F, 3}}};
constexpr std::array<std::array<int, 3>, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};

/// Möller and Trumbore's test; the depth, which is the distance along a ray with z = 1.
float depth_along(const Vector& ray, const std::array<int, 3>& triangle) {
  const Vector a = corners[triangle[0]], e = corners[triangle[1]] - a, f = corners[triangle[2]] - a;
  const Vector p = cross(ray, f), t = Vector{0, 0, 0} - a, q = cross(t, e);
  const float determinant = dot(e, p), u = dot(t, p) / determinant, v = dot(ray, q) / determinant;
  const bool inside = determinant != 0 && u >= 0 && v >= 0 && u + v <= 1;
  return inside ? dot(f, q) / determinant : std::numeric_limits<float>::infinity();
}

float depth_at(int x, int y, const std::string& fault) {
  const float middle = fault == "shift" ? 0 : 0.5F;
  const Vector ray{(x + middle - centre_x) / focal, (y + middle - centre_y) / focal, 1};
  const float depth = std::fmin(depth_along(ray, triangles[0]), depth_along(ray, triangles[1]));
  // Noise: every other pixel, by no rule that a fault of the whole image would have.
  const unsigned hash =
      (static_cast<unsigned>(x) * 73856093U ^ static_cast<unsigned>(y) * 19349663U) >> 7U;
  return fault == "noise" && hash % 2 == 1 ? depth * (1 + static_cast<float>(hash % 97) / 4000)
                                           : depth;
}

}  // namespace

int main(int count, char** arguments) {
  const std::string fault = count > 2 ? arguments[2] : "";
  std::printf("drawing %s\n", arguments[1]);
  std::fflush(stdout);
  if (fault == "crash") std::raise(SIGSEGV);
  if (fault == "fail") return 3;
  if (fault == "hang") std::this_thread::sleep_for(std::chrono::hours(1));
  if (fault == "nothing") return 0;
  std::FILE* file = std::fopen(arguments[1], "wb");
  if (file == nullptr) return 4;
  std::fprintf(file, "Pf\n%d %d\n-1\n", width, height);
  const int last = fault == "half" ? height / 2 : 0;
  for (int y = height - 1; y >= last; --y) {  // a PFM begins with its lowest row
    for (int x = 0; x < width; ++x) {
      const float depth = depth_at(x, y, fault);
      std::fwrite(&depth, sizeof depth, 1, file);
    }
  }
  std::fclose(file);
  // Arguments that a shell or a list would have taken apart.
  const bool odd =
      fault == "odd" && (count != 6 || std::strcmp(arguments[3], "a;b c") != 0 ||
                         arguments[4][0] != '\0' || std::strcmp(arguments[5], "$x'\"[") != 0);
  return odd ? 5 : 0;
}
