// How long authoring takes: a hundred clips of 2 s at 60 frames a second, half of them BVH with the travel in the pose,
// half glTF with root motion, over speeds from 0.6 to 1.7 m/s and turns of 75 deg/s either way.

#include <surefoot/author/author.h>
#include <surefoot/host/files.h>
#include <surefoot/io/bvh.h>
#include <surefoot/io/gltf.h>
#include <surefoot/motion/edit.h>
#include <surefoot/motion/root_motion.h>
#include <surefoot/synthetic/gait_cycle.h>

#include <benchmark/benchmark.h>

#include <algorithm>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

constexpr int k_side = 10;  // speeds, and turns

Motion two_seconds(const Rig& biped, const GaitParameters& walk, int row, int column) {
    GaitParameters gait = walk;
    gait.forward = 0.6f + 1.1f * static_cast<float>(row) / (k_side - 1);
    gait.turn = -75 + 150 * static_cast<float>(column) / (k_side - 1);
    gait.intervals = 60;
    const Motion cycle = make_gait_cycle(biped, gait);
    Motion twice = concatenate(std::vector<Motion>{cycle, cycle});
    twice.name = "clip_" + std::to_string(row) + "_" + std::to_string(column);
    return twice;
}

void write_clip(const fs::path& folder, Motion motion, bool as_bvh) {
    if (as_bvh) {
        bake_root_motion(motion);
        write_file(folder / (motion.name + ".bvh"), write_bvh(motion), Durability::may_be_lost);
        return;
    }
    GltfScene scene;
    scene.motions = {motion};
    write_file(folder / (motion.name + ".glb"), write_glb(scene), Durability::may_be_lost);
}

/// The hundred clips, written at first use, and a place for what comes of them; gone at the end of the program.
class Library {
  public:
    Library() : folder_(fs::temp_directory_path() / ("surefoot_bench_author_" + program_stamp())) {
        fs::remove_all(folder_);
        const std::vector<GaitParameters> gaits = synthetic_gaits();
        const auto walk =
            std::find_if(gaits.begin(), gaits.end(), [](const GaitParameters& gait) { return gait.name == "walk"; });
        walk_ = *walk;
        for (int row = 0; row < k_side; ++row)
            for (int column = 0; column < k_side; ++column)
                write_clip(in(), two_seconds(biped_, walk_, row, column), (row + column) % 2 == 0);
    }
    ~Library() { fs::remove_all(folder_); }

    fs::path in() const { return folder_ / "in"; }
    fs::path out() const { return folder_ / "out"; }

    void author(benchmark::State& state) const {
        const std::string paths[] = {in().string()};
        const AuthorResult result = author_clips(paths, out());
        state.counters["clips"] =
            static_cast<double>(std::count_if(result.project.clips.begin(), result.project.clips.end(),
                                              [](const ProjectClip& clip) { return !clip.excluded; }));
        if (!result.failed.empty()) state.SkipWithError(result.failed.front().c_str());
    }

    /// Changes one clip a little, differently each time.
    void touch() {
        GaitParameters gait = walk_;
        gait.arm_swing += 0.1f * static_cast<float>(++touched_);
        write_clip(in(), two_seconds(biped_, gait, 4, 5), false);
    }

  private:
    fs::path folder_;
    Rig biped_ = make_biped();
    GaitParameters walk_;
    int touched_ = 0;
};

Library& library() {
    static Library instance;
    return instance;
}

void author_cold(benchmark::State& state) {
    for (auto _ : state) {
        state.PauseTiming();
        fs::remove_all(library().out());
        state.ResumeTiming();
        library().author(state);
    }
}

void author_one_clip_changed(benchmark::State& state) {
    library().author(state);
    for (auto _ : state) {
        state.PauseTiming();
        library().touch();
        state.ResumeTiming();
        library().author(state);
    }
}

void author_nothing_changed(benchmark::State& state) {
    library().author(state);
    for (auto _ : state) library().author(state);
}

/// Text to poses, whole: numbers, Euler angles, units, and the checks of what was read.
void bvh_read(benchmark::State& state) {
    std::vector<std::string> texts;
    std::size_t bytes = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(library().in()))
        if (entry.path().extension() == ".bvh") {
            texts.push_back(read_file(entry.path()));
            bytes += texts.back().size();
        }
    for (auto _ : state)
        for (const std::string& text : texts) benchmark::DoNotOptimize(read_bvh(text, "clip.bvh"));
    state.SetBytesProcessed(static_cast<std::int64_t>(bytes) * state.iterations());
}

BENCHMARK(bvh_read)->Unit(benchmark::kMillisecond);
BENCHMARK(author_cold)->Unit(benchmark::kSecond)->UseRealTime()->MeasureProcessCPUTime()->Iterations(1)->Repetitions(5);
BENCHMARK(author_one_clip_changed)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(1)
    ->Repetitions(5);
BENCHMARK(author_nothing_changed)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(1)
    ->Repetitions(5);

}  // namespace
}  // namespace surefoot

BENCHMARK_MAIN();
