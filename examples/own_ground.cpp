// Feet on a ground of your own: an engine would cast rays here.

#include "read_pack.h"

#include <surefoot/ik/foot_placement.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <cstdio>
#include <vector>

namespace {

/// Waves along the way, 15 cm high.
class Waves final : public surefoot::Ground {
  public:
    static float height(float z) noexcept { return z > 1 ? 0.15f * (1 - surefoot::cos(1.5f * (z - 1))) : 0.0f; }
    void query(std::span<const surefoot::GroundQuery> queries,
               std::span<surefoot::GroundHit> hits) const noexcept override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const float z = queries[i].origin.z, slope = (height(z + 0.01f) - height(z - 0.01f)) / 0.02f;
            hits[i] = {true, height(z), surefoot::normalized(surefoot::Vec3{0, 1, -slope}), 0, {}};
        }
    }
};

struct Walker {
    const surefoot::Pack& hero;
    surefoot::LocomotionState state;
    surefoot::RootFrame root;

    /// Goes on by `dt`: the pose in model space, before its feet are placed.
    void go(float dt, std::span<surefoot::Transform> locals, std::span<surefoot::Transform> models) noexcept {
        const surefoot::LocomotionFrame frame = surefoot::update(hero.graph(), state, {.speed = 1.2f}, dt);
        root = root * frame.root_delta;
        surefoot::pose(hero.graph(), frame, locals);
        surefoot::local_to_model(hero.skeleton(), locals, models);
    }
};

/// What the legs will do if nothing else is asked for: a copy of the character, some time on.
class Preview final : public surefoot::LegPreview {
  public:
    Preview(const Walker& walker, const surefoot::FootRig& rig)
        : walker_(walker), rig_(rig), locals_(walker.hero.skeleton().rest.size()), models_(locals_.size()) {}
    void sample(std::span<const float> ahead, std::span<surefoot::LegsPose> legs,
                std::span<surefoot::RootFrame> roots) const noexcept override {
        for (std::size_t i = 0; i < ahead.size(); ++i) {
            Walker copy = walker_;
            copy.go(ahead[i], locals_, models_);
            legs[i] = surefoot::read_legs(rig_, models_);
            roots[i] = copy.root;
        }
    }

  private:
    const Walker& walker_;
    const surefoot::FootRig& rig_;
    mutable std::vector<surefoot::Transform> locals_, models_;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: own_ground X.sfpack\n"), 2;
    const LoadedPack loaded = read_pack(argv[1]);
    const surefoot::Pack& hero = loaded.pack;
    const surefoot::FootRig rig = surefoot::make_foot_rig(hero.skeleton(), hero.legs, hero.standing);
    Walker walker{hero, {}, {}};
    const Preview preview(walker, rig);
    const Waves ground;
    surefoot::FootPlacementState feet;
    std::vector<surefoot::Transform> locals(hero.skeleton().rest.size()), models(locals.size());
    float deepest = 0;
    for (int frame = 0; frame < 600; ++frame) {
        walker.go(frame > 0 ? 1.0f / 60 : 0.0f, locals, models);
        surefoot::FootInput input;
        input.dt = frame > 0 ? 1.0f / 60 : 0.0f;
        input.root = walker.root;
        input.root.position.y = Waves::height(walker.root.position.z);
        input.legs = surefoot::read_legs(rig, models);
        surefoot::FootOutput output;
        surefoot::place_feet(rig, feet, input, ground, &preview, output);
        surefoot::apply(rig, output, models, locals);
        surefoot::local_to_model(hero.skeleton(), locals, models);
        for (const surefoot::Leg& leg : hero.legs.side) {
            const surefoot::Transform foot =
                surefoot::to_transform(input.root) * models[static_cast<std::size_t>(leg.foot)];
            const surefoot::Vec3 heel = surefoot::transform_point(foot, leg.heel);
            deepest = std::max(deepest, Waves::height(heel.z) - heel.y);
        }
    }
    std::printf("ten seconds over waves; no heel was deeper than %.1f cm\n", static_cast<double>(deepest) * 100);
    return deepest < 0.03f ? 0 : 1;
}
