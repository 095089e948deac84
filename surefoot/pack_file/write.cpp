#include <surefoot/pack_file/fields.h>
#include <surefoot/pack_file/format.h>

#include <algorithm>
#include <cassert>
#include <map>

namespace surefoot {

namespace {

/// Definitions go to one buffer, tables to another.
class PackWriter : public FieldWriter<PackWriter> {
  public:
    std::vector<std::byte> definitions, tables;
    std::vector<PackPart> parts;

    template <class... T>
    void part(const char* name, const T&... values) {
        const std::size_t before = definitions.size() + tables.size();
        (*this)(values...);
        parts.push_back({name, definitions.size() + tables.size() - before});
    }

  private:
    friend FieldWriter<PackWriter>;
    template <class T>
    static constexpr bool k_own =
        std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_pointer_v<T> || k_is_a<T, Table> ||
        std::is_same_v<T, std::shared_ptr<const Skeleton>> || std::is_same_v<T, std::shared_ptr<const HarmonicGait>>;
    template <class T>
    static constexpr bool k_in_one_piece = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

    static void append(std::vector<std::byte>& to, const void* data, std::size_t size) {
        const auto* bytes = static_cast<const std::byte*>(data);
        to.insert(to.end(), bytes, bytes + size);
    }
    void raw(const void* data, std::size_t size) { append(definitions, data, size); }
    void write_count(std::size_t count) { own(static_cast<std::uint32_t>(count)); }

    template <class T>
    void own(const T& value) {
        if constexpr (std::is_arithmetic_v<T>) {
            raw(&value, sizeof value);
        } else {
            static_assert(std::is_enum_v<T> && sizeof(T) == 1 && k_values_of<T> > 0);
            own(static_cast<std::uint8_t>(value));
        }
    }
    void own(const FootfallPattern* pattern) {
        assert(!pattern || find_footfall_pattern(pattern->name) == pattern);
        (*this)(std::string(pattern ? pattern->name : std::string_view()));
    }
    /// Clips that share a table share it in the file.
    template <class T>
    void own(const Table<T>& table) {
        const auto [found, is_new] = offsets_.try_emplace({table.data(), table.size()}, 0);
        if (is_new) {
            found->second = sizeof(PackHeader) + tables.size();
            append(tables, table.data(), table.size() * sizeof(T));
            tables.resize(aligned_to_64(tables.size()));
        }
        own(found->second);
        own(static_cast<std::uint64_t>(table.size()));
    }
    void own(const std::shared_ptr<const Skeleton>& skeleton) { shared(skeletons_, skeleton); }
    void own(const std::shared_ptr<const HarmonicGait>& gait) { shared(gaits_, gait); }
    template <class T>
    void shared(std::vector<std::shared_ptr<const T>>& known, const std::shared_ptr<const T>& value) {
        const auto same = [&](const std::shared_ptr<const T>& other) {
            if constexpr (std::is_same_v<T, Skeleton>) return other == value || *other == *value;
            return other == value;
        };
        std::size_t index = 0;
        while (value && index < known.size() && !same(known[index])) ++index;
        write_count(value ? index + 1 : 0);
        if (!value || index < known.size()) return;
        known.push_back(value);
        (*this)(*value);
    }

    std::map<std::pair<const void*, std::size_t>, std::uint64_t> offsets_;
    std::vector<std::shared_ptr<const Skeleton>> skeletons_;
    std::vector<std::shared_ptr<const HarmonicGait>> gaits_;
};

}  // namespace

std::vector<std::byte> pack_bytes(const Pack& pack, std::vector<PackPart>* parts) {
    PackWriter writer;
    writer(pack);
    PackHeader header;
    header.definitions = sizeof(PackHeader) + writer.tables.size();
    header.definitions_size = writer.definitions.size();
    header.size = aligned_to_64(header.definitions + header.definitions_size);
    std::vector<std::byte> bytes(header.size);
    const auto tables_end = std::copy(writer.tables.begin(), writer.tables.end(), bytes.begin() + sizeof header);
    std::copy(writer.definitions.begin(), writer.definitions.end(), tables_end);
    std::memcpy(bytes.data(), &header, sizeof header);
    header.checksum = pack_checksum(std::span<const std::byte>(bytes).subspan(k_checksum_from));
    std::memcpy(bytes.data(), &header, sizeof header);
    if (parts) *parts = std::move(writer.parts);
    return bytes;
}

}  // namespace surefoot
