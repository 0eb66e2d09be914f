// SPDX-License-Identifier: BSD-3-Clause
#include "emulatedRobot.h"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CArchive.h>
#include <salma/observations/CObservationPanTilt.h>
#include <salma/observations/registerClasses.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <thread>

namespace salma::test {

void CEmulatedRobot::addUsualSensors() {
    addSensor("LASER", "laser", 75);
    addSensor("CAMERA", "picture", 10);
    addSensor("HEAD", "head", 20);
}

void CEmulatedRobot::addSensor(const std::string& section,
                               const std::string& kind,
                               double rate,
                               const std::string& more) {
    m_names.push_back(section);
    m_sections += "[" + section + "]\ndriver = CEmulatedSensor\nkind = " + kind +
                  "\nprocess_rate = " + std::to_string(2 * rate) +
                  "\ndevice_rate = " + std::to_string(rate) +
                  "\njournal = " + (m_folder / (section + ".txt")).string() + "\n" + more;
}

std::string CEmulatedRobot::ini(const std::string& head) const {
    return m_folder.write("robot.ini", m_head + head + m_sections);
}

std::vector<std::string> CEmulatedRobot::command(const std::vector<std::string>& more) const {
    std::vector<std::string> words{program("salma-grab"), "-p", SALMA_EMULATED_SENSORS, "--out",
                                   log()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TNumbered CEmulatedRobot::given(const std::string& section) const {
    const auto file = m_folder / (section + ".txt");
    TNumbered records;
    if (!std::filesystem::exists(file)) return records;
    std::istringstream in(readFile(file));
    for (std::string line; std::getline(in, line) && !in.eof();) {
        std::istringstream fields(line);
        long number = 0;
        double stamp = 0;
        if (fields >> number >> stamp) records.emplace_back(number, stamp);
    }
    return records;
}

bool CEmulatedRobot::waitFor(const std::string& section,
                             std::size_t records,
                             CRunningProcess& process) const {
    while (process.running()) {
        if (given(section).size() >= records) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
}

std::map<std::string, TNumbered> CEmulatedRobot::recorded(const std::string& file) {
    observations::registerClasses();
    std::map<std::string, TNumbered> records;
    mrpt::io::CFileGZInputStream in;  // MRPT's own reader, which other programs use
    if (!in.open(file)) return records;
    auto archive = mrpt::serialization::archiveFrom(in);
    try {
        while (true) {
            const auto record =
                std::dynamic_pointer_cast<mrpt::obs::CObservation>(archive.ReadObject());
            if (!record) throw std::runtime_error(file + ": holds what is no observation");
            mrpt::poses::CPose3D pose;
            record->getSensorPose(pose);
            if (const auto head =
                    std::dynamic_pointer_cast<observations::CObservationPanTilt>(record))
                pose = head->basePose;
            records[record->sensorLabel].emplace_back(std::lround(pose.z()),
                                                      mrpt::Clock::toDouble(record->timestamp));
        }
    } catch (const mrpt::serialization::CExceptionEOF&) {
    }
    return records;
}

void CEmulatedRobot::expectAllRecorded() const {
    auto records = recorded(log());
    if (std::filesystem::exists(companion()))
        for (auto& [name, list] : recorded(companion())) records[name] = std::move(list);
    for (const auto& name : m_names) {
        const auto sent = given(name);
        const auto& got = records[name];
        EXPECT_GT(sent.size(), 0U) << name;
        ASSERT_EQ(got.size(), sent.size()) << name;
        for (std::size_t i = 0; i < sent.size(); ++i) {
            ASSERT_EQ(got[i].first, sent[i].first) << name;
            ASSERT_NEAR(got[i].second, sent[i].second, 1e-5) << name;
        }
    }
}

void CEmulatedRobot::forgive(const std::string& section) {
    m_names.erase(std::remove(m_names.begin(), m_names.end(), section), m_names.end());
}

}  // namespace salma::test
