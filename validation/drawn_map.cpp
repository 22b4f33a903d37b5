#include "validation/drawn_map.h"

#include <cstring>
#include <type_traits>
#include <vector>

#include "fathom/numeric/errors.h"

namespace fathom::validation {
namespace {

using attribution::RayModel;

class Writer {
 public:
  std::string bytes;

  template <class T>
  void operator()(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void operator()(const std::string& text) { list(text); }
  template <class T>
  void operator()(const std::vector<T>& values) {
    list(values);
  }

 private:
  template <class List>
  void list(const List& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    bytes.append(reinterpret_cast<const char*>(values.data()),
                 values.size() * sizeof(typename List::value_type));
  }
};

class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(T& value) {
    std::memcpy(&value, take(sizeof value), sizeof value);
  }
  void operator()(std::string& text) { list(text); }
  template <class T>
  void operator()(std::vector<T>& values) {
    list(values);
  }

 private:
  const char* take(std::size_t count) {
    if (bytes_.size() - position_ < count) throw InputError("a renderer's answer ends too soon");
    position_ += count;
    return bytes_.data() + position_ - count;
  }
  template <class List>
  void list(List& values) {
    std::uint64_t size = 0;
    (*this)(size);
    const std::size_t each = sizeof(typename List::value_type);
    if (size > (bytes_.size() - position_) / each) {
      throw InputError("a renderer's answer ends too soon");
    }
    values.resize(size);
    if (size > 0) std::memcpy(values.data(), take(size * each), size * each);
  }

  const std::string& bytes_;
  std::size_t position_ = 0;
};

template <class Pass, class Drawn>
void each_part(Pass& pass, Drawn& drawn) {
  auto& [map, model, version] = drawn;
  pass(version);
  pass(map.width);
  pass(map.height);
  pass(map.depths);
  pass(map.windows);
  pass(map.triangles);
  auto& [name, sample, watertight, first, kind] = model;
  pass(name);
  pass(sample);
  pass(watertight);
  pass(first);
  bool is_ray = std::holds_alternative<RayModel>(kind);
  pass(is_ray);
  if constexpr (!std::is_const_v<Drawn>) {
    if (is_ray) kind = RayModel{};
  }
  std::visit([&](auto& of_kind) { pass(of_kind); }, kind);
}

}  // namespace

std::string to_bytes(const DrawnMap& drawn) {
  Writer writer;
  each_part(writer, drawn);
  return std::move(writer.bytes);
}

DrawnMap drawn_from_bytes(const std::string& bytes) {
  DrawnMap drawn;
  Reader reader(bytes);
  each_part(reader, drawn);
  return drawn;
}

}  // namespace fathom::validation
