#include <surefoot/pack_file/fields.h>
#include <surefoot/pack_file/format.h>

#include <cmath>
#include <map>

namespace surefoot {

namespace {

constexpr const char* k_bake_again = "; bake it again";

bool is_utf8(std::string_view text) noexcept {
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = [&](std::size_t at) { return at < text.size() ? static_cast<unsigned char>(text[at]) : 0u; };
        const unsigned first = byte(i);
        const std::size_t more = first < 0x80   ? 0
                                 : first < 0xc2 ? 9
                                 : first < 0xe0 ? 1
                                 : first < 0xf0 ? 2
                                 : first < 0xf5 ? 3
                                                : 9;
        if (more == 9) return false;
        for (std::size_t k = 1; k <= more; ++k)
            if ((byte(i + k) & 0xc0u) != 0x80u) return false;
        const unsigned second = byte(i + 1);  // no number twice: overlong forms, surrogates, beyond the last
        if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) || (first == 0xf0 && second < 0x90) ||
            (first == 0xf4 && second > 0x8f))
            return false;
        i += more + 1;
    }
    return true;
}

/// No metre, second, radian or parameter of a character is larger, and the square of this is still a float.
bool is_usable(float number) noexcept { return std::fabs(number) <= 1e9f; }

/// Reads definitions and takes nothing on trust: the first thing that is not as it should be ends it.
class PackReader : public FieldReader<PackReader> {
  public:
    PackReader(std::span<const std::byte> bytes, const PackHeader& header)
        : bytes_(bytes),
          tables_end_(header.definitions),
          at_(header.definitions),
          end_(header.definitions + header.definitions_size) {}

    template <class... T>
    void part(const char*, T&... values) {
        (*this)(values...);
    }
    bool sound() const { return problem_.empty(); }
    void fail(const std::string& what) {
        if (sound()) problem_ = "byte " + std::to_string(last_) + " " + what;
    }
    /// What is wrong; empty: all was read, and nothing is left over.
    std::string finish() {
        last_ = at_;
        if (at_ != end_) fail("is beyond what the pack should hold");
        return problem_;
    }

  private:
    friend FieldReader<PackReader>;
    template <class T>
    static constexpr bool k_own =
        std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_pointer_v<T> || std::is_same_v<T, std::string> ||
        k_is_a<T, Table> || std::is_same_v<T, std::shared_ptr<const Skeleton>> ||
        std::is_same_v<T, std::shared_ptr<const HarmonicGait>>;
    template <class T>
    static constexpr bool k_in_one_piece = std::is_integral_v<T> && !std::is_same_v<T, bool>;

    void raw(void* data, std::size_t size) {
        if (!sound() || size == 0) return;
        last_ = at_;
        if (size > end_ - at_) return fail("should be followed by more than there is");
        std::memcpy(data, bytes_.data() + at_, size);
        at_ += size;
    }
    std::size_t read_count(std::size_t least_bytes_each) {
        std::uint32_t count = 0;
        raw(&count, sizeof count);
        if (!sound()) return 0;
        if (count <= (end_ - at_) / least_bytes_each) return count;
        fail("counts more than there is room for");
        return 0;
    }

    template <class T>
    void own(T& value) {
        if constexpr (std::is_same_v<T, bool>) {
            std::uint8_t byte = 0;
            raw(&byte, 1);
            if (byte > 1) fail("is neither yes nor no");
            value = byte == 1;
        } else if constexpr (std::is_arithmetic_v<T>) {
            raw(&value, sizeof value);
            if constexpr (std::is_floating_point_v<T>)
                if (!is_usable(value)) fail("is no number, or too large a one"), value = 0;
        } else {
            static_assert(std::is_enum_v<T> && sizeof(T) == 1 && k_values_of<T> > 0);
            std::uint8_t byte = 0;
            raw(&byte, 1);
            if (byte >= k_values_of<T>) fail("names a choice that is not known"), byte = 0;
            value = static_cast<T>(byte);
        }
    }
    void own(std::string& text) {
        text.resize(read_count(1));
        raw(text.data(), text.size());
        if (!is_utf8(text)) fail("ends a text that is no UTF-8");
    }
    void own(const FootfallPattern*& pattern) {
        std::string name;
        own(name);
        pattern = name.empty() ? nullptr : find_footfall_pattern(name);
        if (!name.empty() && !pattern) fail("names the footfall pattern '" + name + "', which is not known");
    }
    template <class T>
    void own(Table<T>& table) {
        std::uint64_t offset = 0, count = 0;
        own(offset);
        own(count);
        if (!sound() || count == 0) return;
        if (offset < sizeof(PackHeader) || offset > tables_end_ || offset % k_pack_alignment != 0 ||
            count > (tables_end_ - offset) / sizeof(T))
            return fail("names a table that is not there");
        table = Table<T>::of({reinterpret_cast<const T*>(bytes_.data() + offset), static_cast<std::size_t>(count)});
        if (!is_new(offset, count * sizeof(T)) || std::is_integral_v<T>) return;
        static_assert(std::is_integral_v<T> || (sizeof(T) % sizeof(float) == 0 && alignof(T) == alignof(float)));
        const auto* numbers = reinterpret_cast<const float*>(bytes_.data() + offset);
        for (std::size_t i = 0; i < count * (sizeof(T) / sizeof(float)); ++i)
            if (!is_usable(numbers[i])) return fail("names a table with what is no number, or too large a one");
    }
    /// Tables may be named often, but do not overlap: what is to be checked is no more than what is there.
    bool is_new(std::uint64_t offset, std::uint64_t size) {
        const auto [known, is_new] = table_sizes_.try_emplace(offset, size);
        if (is_new) tables_size_ += size;
        if (known->second != size || tables_size_ > tables_end_) fail("names a table that overlaps another");
        return is_new && sound();
    }
    void own(std::shared_ptr<const Skeleton>& skeleton) { shared(skeletons_, skeleton); }
    void own(std::shared_ptr<const HarmonicGait>& gait) { shared(gaits_, gait); }
    template <class T>
    void shared(std::vector<std::shared_ptr<const T>>& known, std::shared_ptr<const T>& value) {
        std::uint32_t index = 0;
        own(index);
        if (!sound() || index == 0) return;
        if (index > known.size() + 1) return fail("names a skeleton or gait that has not come yet");
        if (index == known.size() + 1) {
            T read;
            (*this)(read);
            known.push_back(std::make_shared<const T>(std::move(read)));
        }
        if (sound()) value = known[index - 1];
    }

    std::span<const std::byte> bytes_;
    std::size_t tables_end_, at_, end_, last_ = 0;
    std::string problem_;
    std::map<std::uint64_t, std::uint64_t> table_sizes_;  // by offset
    std::uint64_t tables_size_ = 0;
    std::vector<std::shared_ptr<const Skeleton>> skeletons_;
    std::vector<std::shared_ptr<const HarmonicGait>> gaits_;
};

/// What is wrong with the frame; empty: nothing, and `header` is the pack's.
std::string read_header(std::span<const std::byte> bytes, PackHeader& header) {
    if (bytes.size() < sizeof header)
        return "it is " + std::to_string(bytes.size()) + " bytes long, less than a pack's header; read the whole file";
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.magic != k_pack_magic)
        return "byte 0: it does not begin like a pack; make one with `surefoot bake`, and read it as binary";
    if (header.version != k_pack_version)
        return "byte 8: it is a pack of version " + std::to_string(header.version) + ", and this library reads " +
               std::to_string(k_pack_version) + k_bake_again;
    if (reinterpret_cast<std::uintptr_t>(bytes.data()) % k_least_pack_alignment != 0)
        return "it does not lie at a multiple of 4 bytes; align it to 64";
    if (header.size != bytes.size())
        return "byte 16: it should be " + std::to_string(header.size) + " bytes long and has " +
               std::to_string(bytes.size()) + "; read the whole file and nothing else";
    if (header.checksum != pack_checksum(bytes.subspan(k_checksum_from)))
        return "byte 24: its checksum does not hold, so it has been damaged; copy it anew, or bake it again";
    if (header.reserved != 0 || header.zero != PackHeader{}.zero || header.size % k_pack_alignment != 0 ||
        header.definitions < sizeof header || header.definitions % k_pack_alignment != 0 ||
        header.definitions > header.size || header.definitions_size > header.size - header.definitions)
        return std::string("byte 32: the definitions do not lie within it") + k_bake_again;
    return {};
}

}  // namespace

std::optional<Pack> Pack::open(std::span<const std::byte> bytes, std::string* problem) {
    PackHeader header;
    std::optional<Pack> pack;
    std::string text = read_header(bytes, header);
    if (text.empty()) {
        PackReader reader(bytes, header);
        reader(pack.emplace());
        text = reader.finish();
        if (text.empty()) rebuild(*pack, text);
        if (!text.empty()) text += k_bake_again;
    }
    if (!text.empty()) pack.reset();
    if (problem) *problem = std::move(text);
    return pack;
}

int Pack::clip(std::string_view name) const noexcept {
    for (std::size_t i = 0; i < program.body.clips.size(); ++i)
        if (program.body.clips[i].name == name) return static_cast<int>(i);
    return -1;
}

}  // namespace surefoot
