// The `surefoot` program: finds the subcommand, runs it, turns errors into a message and exit code 2.

#include "command.h"

#include <surefoot/base/error.h>

#include <cstdio>
#include <new>

namespace surefoot::cli {
// One per file beside this one.
extern const Command k_analyze;
extern const Command k_convert;
extern const Command k_mirror, k_reverse, k_cut, k_resample, k_roles;
extern const Command k_author, k_lint, k_walk;
}  // namespace surefoot::cli

int main(int argc, char** argv) {
    using namespace surefoot::cli;
    CLI::App app{
        "Surefoot: characters that walk where you steer, at the speed you ask for, with their feet on the ground"};
    app.set_version_flag("--version", std::string("surefoot ") + SUREFOOT_VERSION);
    app.require_subcommand(1);

    std::function<int()> chosen;
    const Command* commands[] = {&k_analyze, &k_author,  &k_lint, &k_walk,     &k_convert,
                                 &k_mirror,  &k_reverse, &k_cut,  &k_resample, &k_roles};
    for (const Command* command : commands) {
        if (!command) continue;
        CLI::App* sub = app.add_subcommand(command->name, command->help);
        const auto run = command->define(*sub);
        sub->final_callback([&chosen, run] { chosen = run; });
    }
    try {
        app.parse(argc, argv);
        return chosen ? chosen() : 2;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const surefoot::Error& error) {
        std::fprintf(stderr, "surefoot: %s\n", error.what());
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "surefoot: out of memory; work on fewer or shorter clips at a time\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "surefoot: %s\n", error.what());
    }
    return 2;
}
