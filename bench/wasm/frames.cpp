// Frames without a benchmark library: as a WebAssembly module whose `play` JavaScript calls, and as a program that
// times the same call. scripts/bench_wasm.mjs runs both in turns.

#include <surefoot/author/author.h>
#include <surefoot/bake/character.h>
#include <surefoot/course/placed_walker.h>
#include <surefoot/crowd/crowd.h>
#include <surefoot/ground/height_field.h>
#include <surefoot/preset/default_set.h>

#include <cmath>
#include <ctime>
#include <memory>

#include "../stage.h"

namespace surefoot::bench {
namespace {

constexpr float k_dt = 1.0f / 60;

/// What is played; bench_wasm.mjs knows them by their numbers.
enum class Scene {
    crowd = 0,           ///< the synthetic hero, which has no legs
    crowd_on_hills = 1,  ///< the default character, its feet on the ground
    hero_on_hills = 2    ///< one of them that looks ahead and plans
};

const Character& default_character() {
    static const Character made = [] {
        AuthorResult result;
        const Workbench bench = author_workbench(make_default_set().clips, {}, result);
        return bake_character(clips_in_use(bench), bench.project.spaces);
    }();
    return made;
}

class Played {
  public:
    virtual ~Played() = default;
    virtual void frame() = 0;
    /// A number of what was written, which keeps the work from being left out and is the same in every build.
    virtual float sum() const = 0;
};

/// Update, pose and matrices of everybody.
class PlayedCrowd final : public Played {
  public:
    PlayedCrowd(LocomotionGraph graph, std::size_t count, bool on_hills)
        : graph_(std::move(graph)),
          states_(count),
          wishes_(count),
          roots_(count),
          feet_(on_hills ? count : 0),
          matrices_(count * graph_.skeleton->rest.size()),
          scratch_(graph_),
          crowd_{states_, wishes_, roots_} {
        for (std::size_t c = 0; c < count; ++c) {
            states_[c].phase = 0.01f * static_cast<float>(c % 97);
            roots_[c].position = {static_cast<float>(c % 41) - 20, 0, static_cast<float>(c % 71)};
        }
        crowd_.matrices = matrices_;
        if (on_hills) crowd_.ground = &hills_;
        crowd_.feet = feet_;
    }
    void frame() override {
        ++crowd_.frame;
        for (std::size_t c = 0; c < wishes_.size(); ++c) {
            wishes_[c] = wish(c, static_cast<int>(crowd_.frame));
            Vec3& place = roots_[c].position;  // the hills end
            if (std::fabs(place.x) > 28) place.x = -place.x;
            if (place.z > 88) place.z -= 90;
            if (place.z < -8) place.z += 90;
        }
        evaluate(graph_, crowd_, {0, wishes_.size()}, k_dt, scratch_);
    }
    float sum() const override {
        float sum = 0;
        for (const Matrix34& m : matrices_) sum += m.m[3] + m.m[5];
        return sum;
    }

  private:
    LocomotionGraph graph_;
    HeightField hills_ = make_hills();
    std::vector<LocomotionState> states_;
    std::vector<LocomotionRequest> wishes_;
    std::vector<RootFrame> roots_;
    std::vector<CrowdFeet> feet_;
    std::vector<Matrix34> matrices_;
    CrowdScratch scratch_;
    Crowd crowd_;
};

class PlayedHero final : public Played {
  public:
    PlayedHero() { placed_.start(k_speed); }
    void frame() override {
        constexpr int k_lap = 60 * 60;  // the hills end
        if (++frame_ % k_lap == 0) placed_.start(k_speed);
        placed_.advance(k_dt);
    }
    float sum() const override {
        float sum = placed_.root().position.y + placed_.root().position.z;
        for (const Transform& t : placed_.locals()) sum += t.rotation.x + t.translation.y;
        return sum;
    }

  private:
    static constexpr float k_speed = 1.4f;  // [m/s]
    HeightField hills_ = make_hills();
    std::unique_ptr<Walker> walker_ = make_character_walker(default_character());
    PlacedWalker placed_{*walker_, hills_};
    int frame_ = 0;
};

std::unique_ptr<Played> make_played(Scene scene, int characters) {
    const auto count = static_cast<std::size_t>(characters);
    if (scene == Scene::hero_on_hills) return std::make_unique<PlayedHero>();
    const bool on_hills = scene == Scene::crowd_on_hills;
    return std::make_unique<PlayedCrowd>(on_hills ? default_character().graph : make_graph(), count, on_hills);
}

/// Frames of one scene, which is made anew where another is asked for.
float play(Scene scene, int characters, int frames) {
    static std::unique_ptr<Played> played;
    static std::pair<Scene, int> what;
    if (!played || what != std::pair{scene, characters}) {
        what = {scene, characters};
        played = make_played(scene, characters);
    }
    for (int f = 0; f < frames; ++f) played->frame();
    return played->sum();
}

}  // namespace
}  // namespace surefoot::bench

using surefoot::bench::Scene;

#ifdef __EMSCRIPTEN__
extern "C" __attribute__((export_name("play"))) float play(int scene, int characters, int frames) {
    return surefoot::bench::play(static_cast<Scene>(scene), characters, frames);
}
#else
#include <surefoot/clip/sample.h>

#include <cstdio>
#include <cstdlib>

/// SCENE CHARACTERS FRAMES → a line of JSON: [us] of processor time a character and frame, after as many to warm up.
int main(int argc, char** argv) {
    if (argc != 4) return 2;
    const int number = std::atoi(argv[1]), characters = std::atoi(argv[2]), frames = std::atoi(argv[3]);
    if (number < 0 || number > static_cast<int>(Scene::hero_on_hills) || characters < 1 || frames < 1) return 2;
    const auto scene = static_cast<Scene>(number);
    const float warm = surefoot::bench::play(scene, characters, frames);
    const std::clock_t began = std::clock();
    const float sum = surefoot::bench::play(scene, characters, frames);
    const double seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
    std::printf("{\"kernels\": \"%s\", \"us\": %.4f, \"warm\": %.9g, \"sum\": %.9g}\n", surefoot::kernels_name(),
                seconds * 1e6 / characters / frames, static_cast<double>(warm), static_cast<double>(sum));
}
#endif
