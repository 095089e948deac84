#pragma once
// What `surefoot walk` is asked for, and what walks.

#include "character_file.h"
#include "live_gait.h"

#include <surefoot/bake/character.h>
#include <surefoot/course/sweep.h>

#include <functional>
#include <string>
#include <vector>

namespace surefoot::cli {

struct WalkOptions {
    std::string project;
    // None given: hills, straight, 1.4 m/s; with --all, every one that makes sense.
    std::vector<std::string> courses, paths;
    std::vector<float> speeds;
    std::string ik, out, metrics, filmstrip, style;
    std::vector<std::string> set;
    float grade = 15, seconds = 0;
    bool json = false, markdown = false, all = false, transitions = false, reverse = false, keep_pace = false;

    std::string course() const { return courses.empty() ? "hills" : courses.front(); }
    std::string path() const { return paths.empty() ? "straight" : paths.front(); }
    float speed() const { return speeds.empty() ? 1.4f : speeds.front(); }
    float length() const { return seconds > 0 ? seconds : 10; }
};

/// What walks: the character of a project, the steady cycle of a clip, or gaits played live.
struct Walking {
    std::string name;
    CharacterFile file;
    Character character;  ///< of `file`, where that has no program
    LiveGait live;
    RoleMap roles;
    /// A walker on the way that a walk asks for; what it walks with lives here.
    MakeWalker make;
    /// False where it cannot go at a speed straight ahead: a sweep that names none leaves it out.
    std::function<bool(float)> goes_at = [](float) { return true; };
    bool steered = true;  ///< false: it goes one way, straight
};

/// Loads what the options name. `walking` must stay where it is. Throws Error.
void load_walking(WalkOptions& options, Walking& walking);

}  // namespace surefoot::cli
