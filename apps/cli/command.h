#pragma once
// What every subcommand looks like. One file per subcommand defines one `Command`; main.cpp lists them.

#include <CLI/CLI.hpp>

#include <functional>

namespace surefoot::cli {

/// Declares the subcommand's options on `app` and returns what to run if the user chose it. The result is the exit
/// code: 0 done, 1 findings. What cannot run throws surefoot::Error, which main prints to standard error with exit
/// code 2.
struct Command {
    const char* name;
    const char* help;
    std::function<std::function<int()>(CLI::App& app)> define;
};

}  // namespace surefoot::cli
