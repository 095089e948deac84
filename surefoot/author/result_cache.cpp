#include <surefoot/author/byte_archive.h>
#include <surefoot/author/result_cache.h>
#include <surefoot/base/hash.h>
#include <surefoot/host/files.h>

#include <fmt/format.h>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

constexpr char k_magic[] = "surefoot cache 1\n";
constexpr const char* k_extension = ".sfcache";
constexpr std::uint64_t k_second_seed = 0x9e3779b97f4a7c15ull;

std::string name_of(const CacheKey& key) { return fmt::format("{:016x}{:016x}{}", key.high, key.low, k_extension); }

}  // namespace

ResultCache::ResultCache(fs::path folder) : folder_(std::move(folder)), build_(program_stamp()) {
    if (build_.empty()) folder_.clear();
}

CacheKey ResultCache::key(std::string_view content) const {
    return {hash_bytes(content, hash_bytes(build_)), hash_bytes(content, hash_bytes(build_, k_second_seed))};
}

fs::path ResultCache::path(const CacheKey& key) const { return folder_ / name_of(key); }

void ResultCache::used(const CacheKey& key) {
    const std::lock_guard<std::mutex> hold(lock_);
    used_.insert(name_of(key));
}

std::optional<std::string> ResultCache::find(const CacheKey& key) {
    if (!enabled()) return {};
    try {
        std::error_code code;
        if (!fs::exists(path(key), code)) return {};
        const std::string file = read_file(path(key));
        std::string magic, bytes;
        CacheKey own;
        std::uint64_t sum = 0;
        ByteReader reader(file);
        reader(magic, own, sum, bytes);
        if (!reader.complete() || magic != k_magic || !(own == key) || sum != hash_bytes(bytes)) return {};
        used(key);
        return bytes;
    } catch (const std::exception&) {
        return {};
    }
}

void ResultCache::store(const CacheKey& key, std::string_view bytes) {
    if (!enabled()) return;
    try {
        ByteWriter writer;
        writer(std::string(k_magic), key, hash_bytes(bytes), std::string(bytes));
        write_file(path(key), writer.bytes, Durability::may_be_lost);
        used(key);
    } catch (const std::exception&) {
        // A cache that cannot be written is none.
    }
}

void ResultCache::remove_unused() {
    if (!enabled()) return;
    std::error_code code;
    for (fs::directory_iterator entry(folder_, code), end; !code && entry != end; entry.increment(code)) {
        const std::string name = entry->path().filename().string();
        std::error_code ignored;
        if (entry->path().extension() == k_extension && !used_.count(name)) fs::remove(entry->path(), ignored);
    }
}

}  // namespace surefoot
