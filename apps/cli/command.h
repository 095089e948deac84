#pragma once
// What every subcommand looks like. One file per subcommand defines one `Command`; main.cpp lists them.

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace surefoot::cli {

/// Declares the subcommand's options on `app` and returns what to run if the user chose it. The result is the exit
/// code: 0 done, 1 findings. What cannot run throws surefoot::Error, which main prints to standard error with exit
/// code 2.
struct Command {
    const char* name;
    const char* help;
    std::function<std::function<int()>(CLI::App& app)> define;
};

/// Refuses NaN, which passes every range check of CLI11.
inline std::string is_number(const std::string& text) {
    return text.find_first_of("nN") == std::string::npos ? std::string{} : "'" + text + "' is not a number";
}

}  // namespace surefoot::cli
