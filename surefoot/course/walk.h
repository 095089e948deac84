#pragma once
// Walks a character over a course, frame by frame at 60 Hz, as a game would.

#include <surefoot/course/course.h>
#include <surefoot/course/metrics.h>
#include <surefoot/course/path.h>
#include <surefoot/graph/locomotion.h>
#include <surefoot/ik/foot_placement.h>
#include <surefoot/motion/motion.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace surefoot {

struct Character;
struct Pack;
struct LocomotionRequest;
class GraphFrame;
class GraphScratch;

inline constexpr float k_walk_fps = 60;

/// A source of un-placed motion on flat ground: a looped clip, or a baked character with its graph.
class Walker {
  public:
    virtual ~Walker() = default;
    virtual const std::shared_ptr<const Skeleton>& skeleton() const = 0;
    virtual const Legs& legs() const = 0;
    /// A standing pose in model space.
    virtual std::span<const Transform> standing() const = 0;
    /// Back to the start: the root at the origin facing +Z, already walking straight ahead.
    virtual void start(float speed_mps) = 0;
    virtual void advance(float dt) noexcept = 0;
    /// From now on this is asked for instead of what its path says. What cannot be steered does not heed it.
    virtual void steer(const LocomotionRequest& /*asked*/) noexcept {}
    /// From now on it goes no faster, whatever is asked for [m/s]. What cannot be steered does not heed it.
    virtual void limit_speed(float /*mps*/) noexcept {}
    /// From now on it is here, on its way as before. What cannot be steered does not heed it.
    virtual void put(const RootFrame& /*root*/) noexcept {}
    /// It stands on this now (GroundHit::surface).
    virtual void stand_on(std::uint32_t /*surface*/) noexcept {}
    /// Where the root would be had it obeyed exactly.
    virtual RootFrame requested() const noexcept = 0;
    /// True where its host moves the root besides: un-placed, its feet drag.
    virtual bool has_host() const noexcept { return false; }
    /// How much of foot placement its motion asks for now, [0, 1]: nothing in jumps and falls.
    virtual float feet() const noexcept { return 1; }
    /// The clips that it is blended from now; none where it is not of clips.
    virtual std::span<const Leaf> playing() const noexcept { return {}; }
    /// The root in the world (y = 0) and the pose, `ahead` >= 0 seconds from now if nothing else is asked for.
    virtual void look(float ahead, RootFrame& root, std::span<Transform> locals) const noexcept = 0;
    /// A number of that moment, so that who has looked at it need not look again while time passes: what has the same
    /// number looks the same. 0 where it has none.
    virtual std::uint64_t moment(float /*ahead*/) const noexcept { return 0; }
};

/// Plays one cyclic clip with root motion again and again, slower or faster to match the speed asked for (a clip that
/// hardly travels plays as it is).
std::unique_ptr<Walker> make_clip_walker(const Motion& clip, const Legs& legs);

/// Steers a character through its blend space along `path` (none: straight ahead), as a host would: what each leg asks
/// for is approached (`approach`). `character` must outlive the walker. What `asked` says of style, slope and the
/// user's own axes holds all the way; its speed is that of `start`.
std::unique_ptr<Walker> make_character_walker(const Character& character, const LocomotionRequest& asked = {},
                                              std::vector<PathLeg> path = {});

/// What a parameter of a graph is set to.
struct ParameterValue {
    int parameter = 0;
    float value = 0;
};

/// Steers a graph's character along `path` (none: straight ahead) by its parameters "speed" [m/s] and "turn" [deg/s],
/// as far as it has them; `values` hold all the way. A parameter "surface" is told what it stands on. `character` must
/// outlive the walker.
std::unique_ptr<Walker> make_graph_walker(const Pack& character, std::vector<ParameterValue> values = {},
                                          std::vector<PathLeg> path = {});

/// The same for who sets parameters on the way and looks at what plays.
class WatchedGraphWalker : public Walker {
  public:
    /// Asks for a value from now on; of speed and turn as long as nobody steers.
    virtual void ask(const ParameterValue& value) noexcept = 0;
    virtual std::span<const std::byte> state() const noexcept = 0;
};
/// Called after each step of the way, of `dt` seconds, with what program/evaluate.h left: nobody has looked ahead
/// since.
using GraphWatch = std::function<void(float dt, const GraphFrame& frame, const GraphScratch& scratch)>;
std::unique_ptr<WatchedGraphWalker> make_watched_graph_walker(const Pack& character, GraphWatch watch);

struct WalkRequest {
    float speed_mps = 1.4f;
    float seconds = 10;
    FootMode mode = FootMode::surefoot;
    bool limit_pace = true;  ///< the walker goes no faster than foot placement says (FootOutput::speed_limit)
    bool lean = true;        ///< FootSettings::lean
};

struct Walked {
    Motion motion;                             ///< in the world, at k_walk_fps: root frames and placed poses
    std::vector<RootFrame> requested;          ///< one a frame: the root, had it obeyed exactly
    std::array<std::vector<bool>, 2> planted;  ///< by Side, one a frame: stands, says foot placement
    std::vector<float> speed_limit;            ///< [m/s] one a frame, said to the walker after that frame
    int plans = 0;                             ///< how often foot placement planned
};

/// `speed_limit`, where it is given, is said to the walker instead of foot placement's own, frame by frame: the same
/// way with the same timing over other ground.
Walked walk(Walker& walker, const Ground& ground, const WalkRequest& request,
            const std::vector<float>* speed_limit = nullptr);

/// The same walk in several modes, and on flat ground un-placed (the twin), measured; placed in mode surefoot where a
/// host moves the root, for else it would not step. All keep to the pace at which mode surefoot is walked.
struct WalkComparison {
    std::array<Walked, 3> walked;        ///< by FootMode; empty where a mode was not asked for
    std::array<WalkTrack, 3> tracks;     ///< the same
    std::array<WalkMetrics, 3> metrics;  ///< the same
    Walked twin;
    WalkTrack twin_track;
    TwinFigures twin_figures;
    WalkMetrics twin_metrics;  ///< the twin judged as a walk on its own flat ground: what the clip itself is like
    Legs legs;
};
inline constexpr std::array k_foot_modes{FootMode::none, FootMode::colvin2013, FootMode::surefoot};
WalkComparison compare_modes(Walker& walker, const Ground& ground, float speed_mps, float seconds,
                             bool limit_pace = true, std::span<const FootMode> modes = k_foot_modes);

}  // namespace surefoot
