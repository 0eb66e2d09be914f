// SPDX-License-Identifier: BSD-3-Clause
#include "runProgram.h"

#include <algorithm>
#include <exception>
#include <iostream>

namespace salma::apps {

std::string oneLine(const std::string& text) {
    const std::string title = "==== MRPT exception ====", label = "Message:";
    std::size_t from = 0;
    if (text.compare(0, title.size(), title) == 0) {
        const std::size_t at = text.find(label);
        from = text.find_first_not_of(" \n",
                                      at == std::string::npos ? title.size() : at + label.size());
    }
    if (from == std::string::npos) return text;
    return text.substr(from, text.find('\n', from) - from);
}

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
        std::cerr << app.get_name() << ": " << oneLine(e.what()) << "\n";
        return 1;
    }
}

}  // namespace salma::apps
