#pragma once
// A character on a course for somebody to look at and to steer: what the studio's Terrain workspace shows. Plain C++
// that a native build can run as well, so that a test can compare the two bit by bit.

#include "floor.h"
#include "stage_body.h"

#include <surefoot/bake/character.h>
#include <surefoot/course/cycle_walker.h>
#include <surefoot/course/patrol.h>
#include <surefoot/course/placed_walker.h>
#include <surefoot/course/rolling_metrics.h>
#include <surefoot/mannequin/mesh.h>

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace surefoot::wasm {

/// The clips of the bundled gaits.
Character default_character();

/// What a pack holds; points into `bytes`, which must outlive it. Throws Error.
Character packed_character(std::span<const std::byte> bytes);

class Stage {
  public:
    /// `bytes`: what the character points into, if anything.
    explicit Stage(Character character, std::vector<std::byte> bytes = {});

    /// Name, joints, limits of the axes, courses, figures, and where what lies in `frame`: one JSON object
    /// (surefoot.d.mts: CharacterFacts).
    std::string describe() const;

    /// Another course, from its start. Throws Error for a name that is not one.
    void set_course(const std::string& name, float grade_deg);
    void set_mode(FootMode mode) noexcept;
    /// Who steers: somebody with the given request, or a patrol at `speed`.
    void steer(float speed, float lateral, float turn) noexcept;
    /// As it is at a place of a space ("facing", "style:NAME"). Throws Error where there is no such space.
    void steer_to(const std::string& space, std::span<const float> at);
    void patrol(float speed) noexcept;
    void restart();
    /// Where another one was, on the same course and asked for the same: who takes its place.
    void go_on_from(const Stage& before);
    /// From now on this body goes in this cycle instead: on a plane that rises by `rise` a metre along +Z, feet not
    /// placed, steered by nobody. Further calls change cycle, body and plane on the way. True where it is another body,
    /// and with it the mesh and what lies where in a frame. Throws Error for what is no cycle.
    bool play(Motion cycle, const StageBody& body, float rise = 0);
    /// From now on it goes as this walker of its own skeleton says, on flat ground, feet not placed. `asks` says what
    /// is asked of it, once a frame.
    void play(std::shared_ptr<Walker> guest, std::function<LocomotionRequest()> asks);
    /// Who goes instead of its own clips; null: nobody.
    const Walker* guest() const noexcept { return guest_.get(); }
    /// By its own clips again, on the course that it is on, from the start. True where that is another body.
    bool stop_playing();
    const Character& character() const noexcept { return character_; }
    /// Which clips play at a place of a space ("facing"), and how much: a JSON array, heaviest first. Throws Error
    /// where there is no such space.
    std::string weights(const std::string& space, std::span<const float> at) const;
    /// `frames` of 1/60 s, or of a `parts`th of that each: slow motion.
    void advance(int frames, int parts = 1);

    /// The figures of the last seconds, one JSON object a figure in order of CharacterFacts::figures; null where there
    /// is too little yet.
    std::string metrics() const;
    std::span<const float> frame() const noexcept { return frame_; }
    const Mesh& mesh() const noexcept { return mesh_; }
    /// By joint: world to the joint's frame in the pose that the mesh is bound to, 4x4 column-major.
    std::span<const float> inverse_bind() const noexcept { return inverse_bind_; }
    const SurfaceMesh& terrain() const noexcept { return course_.mesh; }

  private:
    const LocomotionSpace& space_named(const std::string& name) const;
    bool wear(const StageBody& body);
    void bind_mesh();
    void put_on_stage(std::shared_ptr<Walker> guest, std::function<LocomotionRequest()> asks);
    void put_on_course();
    void begin();
    FootSettings placement() const noexcept;
    void tilt_floor(float rise);
    bool is_off_course() const noexcept;
    void write_frame();
    void write_ghosts(const Transform& root);

    std::vector<std::byte> bytes_;
    Character character_;
    StageBody body_;  ///< that is seen: the character's, or that of a guest
    Mesh mesh_;
    std::vector<float> inverse_bind_, frame_;
    std::unique_ptr<Walker> walker_;
    std::shared_ptr<Walker> guest_;  ///< goes instead of it, if there is one
    std::function<LocomotionRequest()> asks_;
    CycleWalker* cycle_ = nullptr;  ///< the guest, if it is one
    std::unique_ptr<PlacedWalker> placed_;
    Course course_;
    std::shared_ptr<Floor> floor_ = std::make_shared<Floor>();  ///< of cycles
    float grade_ = 15;
    FootMode mode_ = FootMode::surefoot;
    Patrol patrol_{0};
    bool patrols_ = true;
    float patrol_speed_ = 1.4f;
    LocomotionRequest asked_;
    RollingMetrics rolling_;
    int parts_done_ = 0;  ///< of a frame
    double time_ = 0;     ///< [s] since the start
    float speed_ = 0;     ///< [m/s] of the root, along the ground plane
    float turn_ = 0;      ///< [deg/s]
    std::vector<Transform> models_;
};

}  // namespace surefoot::wasm
