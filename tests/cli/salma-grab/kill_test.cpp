// SPDX-License-Identifier: BSD-3-Clause
// kill -9 at random moments: what is in the file, and what --repair makes of it.
#include <salma/observations/CLogReader.h>

#include <csignal>
#include <filesystem>
#include <memory>
#include <random>
#include <thread>

#include "emulatedRobot.h"

namespace fs = std::filesystem;

namespace salma {
namespace {

using test::contains;

/// One capture that is killed.
class CVictim : public test::CEmulatedRobot {
 public:
    CVictim() {
        addUsualSensors();
        m_process = std::make_unique<test::CRunningProcess>(command({ini()}));
    }
    /// After `records` scans and then `delay`.
    bool kill(std::size_t records, std::chrono::microseconds delay) {
        if (!waitFor("LASER", records, *m_process)) return false;
        std::this_thread::sleep_for(delay);
        m_process->signal(SIGKILL);
        return m_process->wait().exitCode == 128 + SIGKILL;
    }

    void expectAtMostOneSecondMissing() const {
        const auto repaired = test::runProcess({test::program("salma-grab"), "--repair", log()});
        ASSERT_EQ(repaired.exitCode, 0) << repaired.output;
        auto records = recorded(log());
        records["HEAD"] = recorded(companion())["HEAD"];
        for (const auto& name : m_names) {
            const auto sent = given(name);
            const auto& got = records[name];
            ASSERT_GT(got.size(), 0U) << name;
            ASSERT_LE(got.size(), sent.size()) << name;
            for (std::size_t i = 0; i < got.size(); ++i)
                ASSERT_EQ(got[i].first, sent[i].first) << name;  // nothing in between is missing
            EXPECT_LE(sent.back().second - got.back().second, 1.0) << name;
        }
        expectStockProgramsRead(records);
    }

 private:
    void expectStockProgramsRead(std::map<std::string, test::TNumbered>& records) const {
        if (std::system("command -v rawlog-edit >/dev/null") != 0) return;
        const auto info = test::runProcess({"rawlog-edit", "--info", "-i", log()});
        EXPECT_EQ(info.exitCode, 0) << info.output;
        EXPECT_TRUE(contains(
            info.output, "Overall number of objects         : " +
                             std::to_string(records["LASER"].size() + records["CAMERA"].size()) +
                             "\n"))
            << info.output;
    }

    std::unique_ptr<test::CRunningProcess> m_process;
};

}  // namespace

TEST(SalmaGrabKilled, LosesAtMostTheLastSecondAtTwentyRandomMoments) {
    std::mt19937 random(20261122);
    std::uniform_int_distribution<int> scans(80, 200), micro(0, 20000);
    for (int batch = 0; batch < 10; ++batch) {
        std::vector<std::unique_ptr<CVictim>> victims;
        for (int i = 0; i < 2; ++i) victims.push_back(std::make_unique<CVictim>());
        std::vector<std::thread> killers;
        std::vector<char> killed(victims.size(), 0);
        for (std::size_t i = 0; i < victims.size(); ++i) {
            const auto records = static_cast<std::size_t>(scans(random));
            const std::chrono::microseconds delay(micro(random));
            killers.emplace_back(
                [&, i, records, delay] { killed[i] = victims[i]->kill(records, delay) ? 1 : 0; });
        }
        for (auto& killer : killers) killer.join();
        for (std::size_t i = 0; i < victims.size(); ++i) {
            EXPECT_TRUE(killed[i]);
            victims[i]->expectAtMostOneSecondMissing();
        }
    }
}

}  // namespace salma
