// SPDX-License-Identifier: BSD-3-Clause
#include "runProgram.h"

#include <algorithm>
#include <exception>
#include <iostream>

namespace salma::apps {
namespace {

/// MRPT's exceptions carry a call stack on further lines; a user wants the message.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

int runProgram(CLI::App& app,
               const std::string& examples,
               int argc,
               char** argv,
               const std::function<void()>& body) {
    app.description("Examples:\n" + examples + "\n" + app.get_description());
    app.set_version_flag("--version", app.get_name() + " " SALMA_VERSION);
    app.get_formatter()->column_width(34);
    try {
        app.parse(argc, argv);
        body();
        return 0;
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
    } catch (const std::exception& e) {
        std::cerr << app.get_name() << ": " << firstLine(e.what()) << "\n";
        return 1;
    }
}

}  // namespace salma::apps
