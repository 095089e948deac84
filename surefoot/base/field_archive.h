#pragma once
// Structs as sequences of their fields, one description for writing and for reading.
//
// A struct takes part by a function `fields(archive, value)` beside it that hands its members over in order. SUREFOOT_
// FIELDS writes it: a structured binding names every member, so that whoever adds one is told here by the compiler, and
// none can be named and then forgotten.
//
//     SUREFOOT_FIELDS(Vec3, x, y, z)
//
// A writer derives from FieldWriter<itself>, a reader from FieldReader<itself>. What is said here is how containers
// are taken apart; what a number is, and whatever else the two want to treat themselves, is theirs:
//
//     template <class T> static constexpr bool k_own = …;      which types it takes itself
//     template <class T> void own(T& value);                   takes one (a writer: const T&)
//     void raw(void* data, std::size_t size);                  bytes as they are (a writer: const void*)
//     void write_count(std::size_t);   std::size_t read_count(std::size_t least_bytes_each);   bool sound();   void
//     fail(const char*);
//
// A reader that is no longer `sound` gives counts of 0 and leaves values as they are, so that reading ends.

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#define SUREFOOT_FIELDS(Type, ...)                                                                                 \
    template <class Archive, class Value>                                                                          \
    requires(std::is_same_v<std::remove_const_t<Value>, Type>) void fields(Archive& to_archive, Value& of_whole) { \
        auto& [__VA_ARGS__] = of_whole;                                                                            \
        to_archive(__VA_ARGS__);                                                                                   \
    }

namespace surefoot {

template <class T, template <class...> class Of>
inline constexpr bool k_is_a = false;
template <template <class...> class Of, class... T>
inline constexpr bool k_is_a<Of<T...>, Of> = true;
template <class T>
inline constexpr bool k_is_array = std::is_array_v<T>;
template <class T, std::size_t N>
inline constexpr bool k_is_array<std::array<T, N>> = true;

template <class Self>
class FieldWriter {
  public:
    template <class... T>
    void operator()(const T&... values) {
        (put(values), ...);
    }

  private:
    Self& self() { return static_cast<Self&>(*this); }

    template <class T>
    void put(const T& value) {
        if constexpr (Self::template k_own<T>) {
            self().own(value);
        } else if constexpr (std::is_same_v<T, std::string>) {
            self().write_count(value.size());
            self().raw(value.data(), value.size());
        } else if constexpr (k_is_a<T, std::vector>) {
            self().write_count(value.size());
            if constexpr (Self::template k_in_one_piece<typename T::value_type>)
                self().raw(value.data(), value.size() * sizeof(typename T::value_type));
            else
                for (const auto& element : value) put(element);
        } else if constexpr (k_is_array<T>) {
            for (const auto& element : value) put(element);
        } else if constexpr (k_is_a<T, std::pair>) {
            put(value.first), put(value.second);
        } else if constexpr (k_is_a<T, std::map>) {
            self().write_count(value.size());
            for (const auto& entry : value) put(entry);
        } else if constexpr (k_is_a<T, std::shared_ptr>) {
            put(*value);
        } else if constexpr (k_is_a<T, std::variant>) {
            put(static_cast<std::uint8_t>(value.index()));
            std::visit([this](const auto& held) { this->put(held); }, value);
        } else {
            fields(self(), value);
        }
    }
};

template <class Self>
class FieldReader {
  public:
    template <class... T>
    void operator()(T&... values) {
        (get(values), ...);
    }

  private:
    Self& self() { return static_cast<Self&>(*this); }

    template <class T>
    void get(T& value) {
        if constexpr (Self::template k_own<T>) {
            self().own(value);
        } else if constexpr (std::is_same_v<T, std::string>) {
            value.resize(self().read_count(1));
            self().raw(value.data(), value.size());
        } else if constexpr (k_is_a<T, std::vector>) {
            get_vector(value);
        } else if constexpr (k_is_array<T>) {
            for (auto& element : value) get(element);
        } else if constexpr (k_is_a<T, std::pair>) {
            get(value.first), get(value.second);
        } else if constexpr (k_is_a<T, std::map>) {
            value.clear();
            for (std::size_t n = self().read_count(1); n > 0 && self().sound(); --n) {
                std::pair<typename T::key_type, typename T::mapped_type> entry;
                get(entry);
                value.insert(std::move(entry));
            }
        } else if constexpr (k_is_a<T, std::shared_ptr>) {
            std::remove_const_t<typename T::element_type> held;
            this->get(held);
            value = std::make_shared<typename T::element_type>(std::move(held));
        } else if constexpr (k_is_a<T, std::variant>) {
            std::uint8_t index = 0;
            get(index);
            get_alternative(value, index, std::make_index_sequence<std::variant_size_v<T>>());
        } else {
            fields(self(), value);
        }
    }
    template <class T>
    void get_vector(std::vector<T>& values) {
        if constexpr (Self::template k_in_one_piece<T>) {
            values.resize(self().read_count(sizeof(T)));
            self().raw(values.data(), values.size() * sizeof(T));
        } else {
            values.clear();
            for (std::size_t n = self().read_count(1); n > 0 && self().sound(); --n) get(values.emplace_back());
        }
    }
    template <class Variant, std::size_t... Index>
    void get_alternative(Variant& value, std::size_t index, std::index_sequence<Index...>) {
        const auto take = [&](auto held) {
            this->get(held);
            value = std::move(held);
            return true;
        };
        const bool known = ((index == Index && take(std::variant_alternative_t<Index, Variant>())) || ...);
        if (!known) self().fail("names a kind that is not known");
    }
};

}  // namespace surefoot
