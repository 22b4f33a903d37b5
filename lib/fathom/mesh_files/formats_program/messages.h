#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// The messages between the library and the program fathom-formats over a socket. A request is a
/// RequestHead, its parameters and the bytes to read; a reply is a ReplyHead and its bytes. Numbers
/// have the machine's format. Only for .cpp files of this module and of that program.
namespace fathom::mesh_files::formats_program {

/// The program is started as `fathom-formats --serve VERSION`, and ends with this status where its
/// own version is another. Raised with every change of a message.
inline constexpr std::string_view serve = "--serve";
inline constexpr std::string_view message_version = "1";
inline constexpr int other_version = 64;

enum class Task : std::uint32_t { assimp, draco, meshopt };

/// The parameters of Task::meshopt: [EMC20].
enum class MeshoptMode : std::uint32_t { attributes, triangles, indices };
enum class MeshoptFilter : std::uint32_t { none, octahedral, quaternion, exponential };
struct MeshoptView {
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;
  std::uint64_t count = 0, stride = 0;
};

/// The parameters of Task::draco are a list of these; the first is of the corners of triangles.
struct DracoAttribute {
  std::uint32_t number = 0;
  /// The component type of glTF that its numbers are to have, and how many to a vertex.
  std::uint32_t component = 0, width = 0;
};

struct RequestHead {
  Task task = Task::assimp;
  /// Limit of processor time for this request.
  std::uint32_t seconds = 0;
  /// Limit of the program's address space, in bytes.
  std::uint64_t memory = 0;
  std::uint64_t parameter_bytes = 0;
  std::uint64_t bytes = 0;
};

struct ReplyHead {
  /// The bytes that follow are the reason why there is no answer, a text.
  std::uint64_t refused = 0;
  std::uint64_t bytes = 0;
};

/// Sends or receives all bytes. False if the other program has ended.
bool send_all(int socket, std::span<const std::byte> bytes);
bool receive_all(int socket, std::span<std::byte> bytes);

/// Puts numbers, texts and lists one behind the other.
class MessageWriter {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&value, sizeof value);
  }
  template <class T>
  void put_list(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(std::uint64_t{values.size()});
    append(values.data(), values.size_bytes());
  }
  void put_text(std::string_view text) { put_list(std::span<const char>(text)); }

  void append(const MessageWriter& more) { append(more.bytes_.data(), more.bytes_.size()); }

  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  void append(const void* data, std::size_t size) {
    const std::size_t end = bytes_.size();
    bytes_.resize(end + size);
    std::copy_n(static_cast<const std::byte*>(data), size, bytes_.data() + end);
  }

  std::vector<std::byte> bytes_;
};

/// A message that is not what its writer promises.
class BadMessage : public std::runtime_error {
 public:
  BadMessage() : std::runtime_error("the answer of fathom-formats makes no sense") {}
};

/// A list within a message, which need not be aligned; the message must outlive it.
template <class T>
class MessageList {
 public:
  MessageList() = default;
  explicit MessageList(std::span<const std::byte> bytes) : bytes_(bytes) {}
  [[nodiscard]] std::size_t size() const { return bytes_.size() / sizeof(T); }
  T operator[](std::size_t i) const {
    T value;
    std::memcpy(&value, bytes_.data() + i * sizeof(T), sizeof(T));
    return value;
  }
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

/// Reads a message of a MessageWriter without trusting it: a part that claims to be longer than the
/// message is a BadMessage.
class MessageReader {
 public:
  explicit MessageReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    return MessageList<T>(take(sizeof(T)))[0];
  }
  template <class T>
  MessageList<T> get_list() {
    const auto count = get<std::uint64_t>();
    if (count > rest_.size() / sizeof(T)) throw BadMessage();
    return MessageList<T>(take(count * sizeof(T)));
  }
  std::string get_text() {
    const std::span<const std::byte> text = get_list<char>().bytes();
    return {reinterpret_cast<const char*>(text.data()), text.size()};
  }

 private:
  std::span<const std::byte> take(std::size_t size) {
    if (size > rest_.size()) throw BadMessage();
    const std::span<const std::byte> taken = rest_.first(size);
    rest_ = rest_.subspan(size);
    return taken;
  }

  std::span<const std::byte> rest_;
};

}  // namespace fathom::mesh_files::formats_program
