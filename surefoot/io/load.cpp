#include <surefoot/base/error.h>
#include <surefoot/host/files.h>
#include <surefoot/host/parallel.h>
#include <surefoot/host/progress.h>
#include <surefoot/io/assimp_import.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/clip_name.h>
#include <surefoot/io/gltf.h>
#include <surefoot/io/load.h>
#include <surefoot/io/sidecar.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>

namespace surefoot {

namespace fs = std::filesystem;

namespace {

std::string extension(std::string_view path) {
    const std::size_t dot = path.rfind('.');
    if (dot == std::string_view::npos || path.find_first_of("/\\", dot) != std::string_view::npos) return {};
    std::string text(path.substr(dot));
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

/// One file to read, and which of its clips.
struct Wanted {
    std::string path;
    std::optional<std::string> pick;  // NAME or number
    std::string as_given;
};

struct Outcome {
    std::vector<LoadedClip> clips;
    std::string error;
};

/// All clip files below a folder. Links to folders are not followed: they may form a ring.
std::vector<Wanted> search_folder(const std::string& folder) {
    std::vector<Wanted> found;
    std::error_code code;
    fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, code), end;
    while (!code && at != end) {
        std::error_code ignored;
        const std::string path = at->path().string();
        if (is_clip_file(path) && at->is_regular_file(ignored)) found.push_back({path, {}, path});
        at.increment(code);
    }
    if (code) throw Error("cannot be searched: " + code.message(), folder, "check its permissions");
    if (found.empty())
        throw Error("no clips in this folder", folder, "it should hold .bvh, .glb, .gltf, .fbx or .dae files");
    return found;
}

std::vector<Wanted> find_files(const std::string& given) {
    std::error_code code;
    if (fs::is_directory(given, code)) return search_folder(given);
    if (fs::exists(given, code)) return {{given, {}, given}};
    const std::size_t hash = given.rfind('#');
    if (hash != std::string::npos && fs::exists(given.substr(0, hash), code))
        return {{given.substr(0, hash), given.substr(hash + 1), given}};
    throw Error("no such file or folder", given, "check the path");
}

/// FILE#NAME, or else FILE#3 where no clip has that for a name.
std::vector<LoadedClip> pick_clip(std::vector<LoadedClip> clips, const Wanted& wanted) {
    const std::string& pick = *wanted.pick;
    // By the name we give it, or by the one it has in the file ("Armature|Walk" for Walk).
    const std::string cleaned = is_generic_clip_name(pick) ? pick : clip_name(pick, wanted.path);
    for (const std::string& name : {pick, cleaned})
        for (LoadedClip& clip : clips)
            if (clip.motion.name == name) return {std::move(clip)};
    const bool number = !pick.empty() && pick.size() < 7 && pick.find_first_not_of("0123456789") == std::string::npos;
    if (number && static_cast<std::size_t>(std::stoi(pick)) < clips.size())
        return {std::move(clips[static_cast<std::size_t>(std::stoi(pick))])};
    std::string names;
    for (std::size_t i = 0; i < std::min<std::size_t>(clips.size(), 10); ++i)
        names += (i > 0 ? ", " : "") + clips[i].motion.name;
    if (clips.size() > 10) names += ", …";
    throw Error("the file has no clip '" + pick + "'", wanted.path,
                "it has " + std::to_string(clips.size()) + ": " + names);
}

/// Where files are: on disk or in memory.
struct Shelf {
    std::function<bool(const std::string& path)> has;
    std::function<std::string(const std::string& path)> read;
};

Outcome read_one(const Wanted& wanted, const Shelf& shelf, const LoadOptions& options) {
    Outcome outcome;
    try {
        std::vector<LoadedClip> clips = read_clips(shelf.read(wanted.path), wanted.path, options);
        const std::string sidecar = sidecar_path(wanted.path);
        if (shelf.has(sidecar)) apply_sidecar(shelf.read(sidecar), sidecar, clips);
        outcome.clips = wanted.pick ? pick_clip(std::move(clips), wanted) : std::move(clips);
    } catch (const std::bad_alloc&) {
        outcome.error = Error("not enough memory for this file", wanted.path, "split it").what();
    } catch (const std::exception& error) {
        outcome.error = error.what();
    }
    return outcome;
}

/// Clips of equal skeletons share one, the first.
void share_skeletons(std::vector<LoadedClip>& clips) {
    std::vector<std::shared_ptr<const Skeleton>> known;
    for (LoadedClip& clip : clips) {
        const auto same = std::find_if(known.begin(), known.end(), [&](const auto& skeleton) {
            return skeleton == clip.motion.skeleton || *skeleton == *clip.motion.skeleton;
        });
        if (same == known.end())
            known.push_back(clip.motion.skeleton);
        else
            clip.motion.skeleton = *same;
    }
}

/// Reads what is wanted, which is in order, and adds it to `result`.
void read_all(const std::vector<Wanted>& wanted, const Shelf& shelf, const LoadOptions& options, LoadResult& result) {
    std::vector<Outcome> outcomes(wanted.size());
    Progress progress("reading", wanted.size());
    parallel_for(wanted.size(), [&](std::size_t i) {
        outcomes[i] = read_one(wanted[i], shelf, options);
        progress.advance();
    });
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (!outcomes[i].error.empty()) result.failed.push_back({wanted[i].as_given, outcomes[i].error});
        for (LoadedClip& clip : outcomes[i].clips) result.clips.push_back(std::move(clip));
    }
    std::stable_sort(result.failed.begin(), result.failed.end(),
                     [](const LoadFailure& a, const LoadFailure& b) { return a.file < b.file; });
    share_skeletons(result.clips);
    std::vector<std::string*> names;
    for (LoadedClip& clip : result.clips) names.push_back(&clip.motion.name);
    make_unique(names);
}

}  // namespace

bool is_clip_file(std::string_view path) {
    const std::string ext = extension(path);
    return ext == ".bvh" || ext == ".glb" || ext == ".gltf" || ext == ".fbx" || ext == ".dae";
}

std::vector<LoadedClip> read_clips(std::string_view bytes, const std::string& where, const LoadOptions& options) {
    const std::string ext = extension(where);
    std::vector<LoadedClip> clips;
    if (ext == ".bvh")
        clips.push_back(read_bvh(bytes, where, options));
    else if (ext == ".glb" || ext == ".gltf")
        clips = read_gltf(bytes, where, options);
    else if (ext == ".fbx" || ext == ".dae")
#ifndef __EMSCRIPTEN__
        clips = read_fbx_or_collada(bytes, where, options);
#else
        throw Error("FBX and Collada are not read in a browser", where, "`surefoot convert` makes a .glb of it");
#endif
    else
        throw Error("the extension '" + ext + "' is not one of a clip", where,
                    "clips are .bvh, .glb, .gltf, .fbx or .dae files");
    for (LoadedClip& clip : clips) clip.motion.name = clip_name(clip.motion.name, where);
    std::vector<std::string*> names;
    for (LoadedClip& clip : clips) names.push_back(&clip.motion.name);
    make_unique(names);
    for (LoadedClip& clip : clips) clip.file = clips.size() > 1 ? where + "#" + clip.motion.name : where;
    return clips;
}

LoadResult load_clips(std::span<const std::string> paths, const LoadOptions& options) {
    LoadResult result;
    std::vector<Wanted> wanted;
    for (const std::string& given : paths) try {
            std::vector<Wanted> found = find_files(given);
            wanted.insert(wanted.end(), found.begin(), found.end());
        } catch (const Error& error) {
            result.failed.push_back({given, error.what()});
        }
    const auto order = [](const Wanted& a, const Wanted& b) { return a.as_given < b.as_given; };
    std::stable_sort(wanted.begin(), wanted.end(), order);
    wanted.erase(std::unique(wanted.begin(), wanted.end(),
                             [](const Wanted& a, const Wanted& b) { return a.as_given == b.as_given; }),
                 wanted.end());
    const auto is_there = [](const std::string& path) {
        std::error_code ignored;
        return fs::exists(path, ignored);
    };
    read_all(wanted, {is_there, [](const std::string& path) { return read_file(path); }}, options, result);
    return result;
}

LoadResult load_clips_in_memory(const std::map<std::string, std::string>& files, const LoadOptions& options) {
    std::vector<Wanted> wanted;
    for (const auto& [name, bytes] : files)
        if (is_clip_file(name)) wanted.push_back({name, {}, name});
    LoadResult result;
    read_all(wanted,
             {[&](const std::string& name) { return files.count(name) > 0; },
              [&](const std::string& name) { return files.at(name); }},
             options, result);
    return result;
}

}  // namespace surefoot
