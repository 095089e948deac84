#pragma once
// Results of long work kept in a folder, found again by the content that they were made of. Private to the room.
//
// Nothing depends on the folder: it may be deleted, cut short or filled with rubbish at any time, which costs time
// only. An entry counts only if its checksum holds and it was made by this very build of the program.

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace surefoot {

struct CacheKey {
    std::uint64_t low = 0, high = 0;

    friend bool operator==(const CacheKey&, const CacheKey&) = default;
};

class ResultCache {
  public:
    /// Without a folder, or where the program cannot tell one build from another, it keeps nothing.
    explicit ResultCache(std::filesystem::path folder);

    bool enabled() const { return !folder_.empty(); }
    /// The key of a result that depends on `content` and on this build.
    CacheKey key(std::string_view content) const;

    // Both are safe from several threads and never throw.

    /// What was stored, or nothing.
    std::optional<std::string> find(const CacheKey& key);
    /// Does nothing where the folder cannot be written.
    void store(const CacheKey& key, std::string_view bytes);

    /// Removes the entries that were neither found nor stored since this object was made.
    void remove_unused();

  private:
    std::filesystem::path path(const CacheKey& key) const;
    void used(const CacheKey& key);

    std::filesystem::path folder_;
    std::string build_;
    std::mutex lock_;
    std::set<std::string> used_;
};

}  // namespace surefoot
