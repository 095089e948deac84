// surefoot retarget IN OUT --to TARGET: the clips of one character on another.

#include "actor.h"
#include "clip_files.h"
#include "command.h"

#include <surefoot/base/error.h>
#include <surefoot/host/parallel.h>
#include <surefoot/io/clip_extras.h>

#include <fmt/format.h>

#include <memory>

namespace surefoot::cli {
namespace {

struct Options {
    std::string in, out, to;
    std::vector<std::string> roles, to_roles;
};

int run(const Options& options) {
    check_clip_output(options.out);
    const Actor target = read_actor(options.to, parse_roles(options.to_roles, "--to-roles"));
    const RoleOverrides roles = parse_roles(options.roles, "--roles");
    std::vector<LoadedClip> clips = read_clip_files(options.in);
    std::vector<RetargetReport> reports(clips.size());
    const Actor source = actor_in(clips, roles);
    parallel_for(clips.size(), [&](std::size_t i) {
        Motion& motion = clips[i].motion;
        if (!(*motion.skeleton == *source.body.skeleton))
            throw Error("it moves another skeleton than the first clip", clips[i].file,
                        "retarget one character's clips at a time: IN#NAME picks one");
        const RoleMap& joints = source.body.roles;
        bring_to_ground(motion, source.body, find_footing(motion, joints, make_tracks(motion, joints)));
        motion = retarget(motion, source.body, target.body, {}, &reports[i]);
        clips[i].rotation_order.clear();
        ClipEdit done;
        done.kind = ClipEdit::Kind::resampled;
        done.duration = motion.duration();
        done.cyclic = motion.cyclic;
        done.text = fmt::format("retargeted to the skeleton of {} ({} joints, legs {:.3g} times as long)", options.to,
                                motion.joint_count(), reports[i].scale);
        clips[i].extras = edited_extras(clips[i].extras.empty() ? "{}" : clips[i].extras, done);
    });
    write_clip_file(clips, options.out, {{}, true, target.body.legs});
    fmt::print(stderr, "{} {} retargeted to {}: legs, and with them speeds, are {:.3g} times those of the source\n",
               clips.size(), clips.size() == 1 ? "clip" : "clips", options.to, reports.front().scale);
    return 0;
}

}  // namespace

extern const Command k_retarget;
const Command k_retarget{
    "retarget", "put clips of one character onto another", [](CLI::App& app) -> std::function<int()> {
        auto options = std::make_shared<Options>();
        app.add_option("IN", options->in, "clips to read: .bvh, .glb, .gltf, .fbx, or FILE#NAME")->required();
        app.add_option("OUT", options->out, "file to write: .bvh or .glb, which wears a mannequin")->required();
        app.add_option("--to", options->to,
                       "whose skeleton: a clip or character (file or FILE#NAME), or `default`, the generated biped. "
                       "Only the skeleton is taken: a character's own mesh is not written")
            ->required();
        app.add_option("--roles", options->roles, "joints of IN by hand, as left_foot=Foot_L (repeatable)")
            ->allow_extra_args(false);
        app.add_option("--to-roles", options->to_roles, "the same for the target (repeatable)")
            ->allow_extra_args(false);
        app.footer(
            "Speeds and paths scale with the length of the legs; cadence, turn rates and slopes stay. Feet stay where\n"
            "they stand. The clip's ground comes to height 0.");
        return [options] { return run(*options); };
    }};

}  // namespace surefoot::cli
