#pragma once
// Values as bytes and back, for caches: of this program on this machine, nothing to send anywhere. Private to the room.
//
// A struct takes part by functions `fields(archive, value)` beside it that name its members in order, for reading and
// for writing. What has none and is trivially copyable goes as it lies in memory, and must have no padding.

#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace surefoot {

class ByteWriter;
template <typename T>
inline constexpr bool k_goes_raw = std::is_trivially_copyable_v<T> && !requires(ByteWriter & archive, const T& value) {
    fields(archive, value);
};

class ByteWriter {
  public:
    template <typename... T>
    void operator()(const T&... values) {
        (put(values), ...);
    }
    std::string bytes;

  private:
    void raw(const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); }
    void count(std::size_t n) {
        const auto value = static_cast<std::uint64_t>(n);
        raw(&value, sizeof value);
    }
    void put(const std::string& text) { count(text.size()), raw(text.data(), text.size()); }
    template <typename T>
    void put(const std::shared_ptr<const T>& pointer) {
        put(*pointer);
    }
    template <typename T>
    void put(const std::vector<T>& values) {
        count(values.size());
        if constexpr (k_goes_raw<T>)
            raw(values.data(), values.size() * sizeof(T));
        else
            for (const T& value : values) put(value);
    }
    template <typename T, typename U>
    void put(const std::pair<T, U>& pair) {
        put(pair.first), put(pair.second);
    }
    template <typename T, typename U>
    void put(const std::map<T, U>& values) {
        count(values.size());
        for (const auto& value : values) put(value);
    }
    template <typename T, std::size_t N>
    void put(const T (&values)[N]) {
        for (const T& value : values) put(value);
    }
    template <typename T>
    void put(const T& value) {
        if constexpr (k_goes_raw<T>)
            raw(&value, sizeof value);
        else
            fields(*this, value);
    }
};

/// Reads what a ByteWriter wrote. Bytes that are none of its making give false, never more memory than they promise.
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : left_(bytes) {}

    template <typename... T>
    void operator()(T&... values) {
        (get(values), ...);
    }
    /// Everything so far was there, and nothing is left over.
    bool complete() const { return sound_ && left_.empty(); }

  private:
    void raw(void* data, std::size_t size) {
        if (size > left_.size()) sound_ = false, left_ = {};
        if (!sound_ || size == 0) return;
        std::memcpy(data, left_.data(), size);
        left_.remove_prefix(size);
    }
    /// How many values of at least `size` bytes follow; 0 where so many cannot.
    std::size_t count(std::size_t size) {
        std::uint64_t n = 0;
        raw(&n, sizeof n);
        if (n > left_.size() / size) sound_ = false, n = 0;
        return static_cast<std::size_t>(n);
    }
    void get(std::string& text) { text.resize(count(1)), raw(text.data(), text.size()); }
    template <typename T>
    void get(std::shared_ptr<const T>& pointer) {
        T value;
        get(value);
        pointer = std::make_shared<const T>(std::move(value));
    }
    template <typename T>
    void get(std::vector<T>& values) {
        if constexpr (k_goes_raw<T>) {
            values.resize(count(sizeof(T)));
            raw(values.data(), values.size() * sizeof(T));
        } else {
            values.clear();
            for (std::size_t n = count(1); n > 0 && sound_; --n) get(values.emplace_back());
        }
    }
    template <typename T, typename U>
    void get(std::pair<T, U>& pair) {
        get(pair.first), get(pair.second);
    }
    template <typename T, typename U>
    void get(std::map<T, U>& values) {
        values.clear();
        for (std::size_t n = count(1); n > 0 && sound_; --n) {
            std::pair<T, U> value;
            get(value);
            values.insert(std::move(value));
        }
    }
    template <typename T, std::size_t N>
    void get(T (&values)[N]) {
        for (T& value : values) get(value);
    }
    template <typename T>
    void get(T& value) {
        if constexpr (k_goes_raw<T>)
            raw(&value, sizeof value);
        else
            fields(*this, value);
    }

    std::string_view left_;
    bool sound_ = true;
};

}  // namespace surefoot
