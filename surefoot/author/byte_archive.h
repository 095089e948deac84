#pragma once
// Values as bytes and back, for caches: of this program on this machine, nothing to send anywhere. Private to the room.
//
// What has no `fields` (base/field_archive.h) and is trivially copyable goes as it lies in memory, and must have no
// padding.

#include <surefoot/base/field_archive.h>

#include <cstring>
#include <string>
#include <string_view>

namespace surefoot {

class ByteWriter;
template <typename T>
inline constexpr bool k_goes_raw =
    std::is_trivially_copyable_v<T> && !std::is_array_v<T> && !requires(ByteWriter & archive, const T& value) {
    fields(archive, value);
};

class ByteWriter : public FieldWriter<ByteWriter> {
  public:
    std::string bytes;

  private:
    friend FieldWriter<ByteWriter>;
    template <typename T>
    static constexpr bool k_own = k_goes_raw<T>;
    template <typename T>
    static constexpr bool k_in_one_piece = k_goes_raw<T>;
    template <typename T>
    void own(const T& value) {
        raw(&value, sizeof value);
    }
    void raw(const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); }
    void write_count(std::size_t n) {
        const auto value = static_cast<std::uint64_t>(n);
        raw(&value, sizeof value);
    }
};

/// Reads what a ByteWriter wrote. Bytes that are none of its making give false, never more memory than they promise.
class ByteReader : public FieldReader<ByteReader> {
  public:
    explicit ByteReader(std::string_view bytes) : left_(bytes) {}
    /// Everything so far was there, and nothing is left over.
    bool complete() const { return sound_ && left_.empty(); }

  private:
    friend FieldReader<ByteReader>;
    template <typename T>
    static constexpr bool k_own = k_goes_raw<T>;
    template <typename T>
    static constexpr bool k_in_one_piece = k_goes_raw<T>;
    template <typename T>
    void own(T& value) {
        raw(&value, sizeof value);
    }
    void fail(const char*) { sound_ = false, left_ = {}; }
    bool sound() const { return sound_; }
    void raw(void* data, std::size_t size) {
        if (size > left_.size()) fail("");
        if (!sound_ || size == 0) return;
        std::memcpy(data, left_.data(), size);
        left_.remove_prefix(size);
    }
    /// How many values of at least `size` bytes follow; 0 where so many cannot.
    std::size_t read_count(std::size_t size) {
        std::uint64_t n = 0;
        raw(&n, sizeof n);
        if (n > left_.size() / size) sound_ = false, n = 0;
        return static_cast<std::size_t>(n);
    }

    std::string_view left_;
    bool sound_ = true;
};

}  // namespace surefoot
