// SPDX-License-Identifier: BSD-3-Clause
#include "runProgram.h"

#include <gtest/gtest.h>
#include <mrpt/core/exceptions.h>

#include <iostream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace salma::apps {
namespace {

/// Holds what goes to a stream while it lives.
class CCapture {
 public:
    explicit CCapture(std::ostream& stream)
        : m_stream(stream), m_old(stream.rdbuf(m_text.rdbuf())) {}
    ~CCapture() { m_stream.rdbuf(m_old); }
    CCapture(const CCapture&) = delete;
    CCapture& operator=(const CCapture&) = delete;

    std::string text() const { return m_text.str(); }

 private:
    std::ostringstream m_text;
    std::ostream& m_stream;
    std::streambuf* m_old;
};

struct TResult {
    int exitCode;
    std::string out, err;
};

/// Runs a program `tool` with one option `--size INT` and the required argument FILE.
TResult run(std::vector<std::string> arguments, const std::function<void()>& body) {
    CLI::App app("Does a thing.", "tool");
    int size = 0;
    std::string file;
    app.add_option("--size", size, "how large");
    app.add_option("FILE", file, "what to read")->required();
    arguments.insert(arguments.begin(), "tool");
    std::vector<char*> argv;
    for (auto& a : arguments) argv.push_back(a.data());
    const CCapture out(std::cout), err(std::cerr);
    const int code =
        runProgram(app, "  tool a.txt\n", static_cast<int>(argv.size()), argv.data(), body);
    return {code, out.text(), err.text()};
}

void mustNotRun() { ADD_FAILURE() << "the body ran"; }

TEST(RunProgram, ReturnsZeroAfterTheBody) {
    int calls = 0;
    const auto result = run({"a.txt", "--size", "3"}, [&] { ++calls; });
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(result.out + result.err, "");
}

TEST(RunProgram, ReturnsOneAndPrintsOneLineIfTheBodyThrows) {
    const auto result = run({"a.txt"}, [] { throw std::runtime_error("a.txt: is empty"); });
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "tool: a.txt: is empty\n");
}

TEST(RunProgram, PrintsAnExceptionOfMrptAsOneLineWithItsMessage) {
    const auto fails = [] {
        MRPT_START
        THROW_EXCEPTION("a.txt: has no poses");
        MRPT_END
    };
    std::string whole;
    try {
        fails();
    } catch (const std::exception& e) {
        whole = e.what();
    }
    ASSERT_NE(whole.find('\n'), std::string::npos) << "MRPT prints one line by itself";
    const auto result = run({"a.txt"}, fails);
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(result.err, "tool: a.txt: has no poses\n");
}

TEST(RunProgram, ReturnsTwoForMisuseAndDoesNotRunTheBody) {
    using TArguments = std::vector<std::string>;
    for (const auto& arguments :
         {TArguments{}, TArguments{"a.txt", "--no-such-flag"}, TArguments{"a.txt", "b.txt"},
          TArguments{"a.txt", "--size", "large"}, TArguments{"a.txt", "--size"}}) {
        const auto result = run(arguments, mustNotRun);
        EXPECT_EQ(result.exitCode, 2) << testing::PrintToString(arguments);
        EXPECT_NE(result.err, "") << testing::PrintToString(arguments);
    }
}

TEST(RunProgram, ReturnsTwoIfTheBodyFindsMisuse) {
    const auto result = run({"a.txt"}, [] { throw CLI::RequiredError("--out"); });
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.err.find("--out is required"), std::string::npos) << result.err;
}

TEST(RunProgram, StartsItsHelpWithTheExamples) {
    const auto result = run({"--help"}, mustNotRun);
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.out.find("Examples:\n  tool a.txt\n\nDoes a thing.\n"), 0U) << result.out;
    EXPECT_NE(result.out.find("--size INT"), std::string::npos) << result.out;
}

TEST(RunProgram, PrintsItsNameAndVersion) {
    const auto result = run({"--version"}, mustNotRun);
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.out.find("tool "), 0U) << result.out;
    EXPECT_NE(result.out.find_first_of("0123456789"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace salma::apps
