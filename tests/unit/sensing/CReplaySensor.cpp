// SPDX-License-Identifier: BSD-3-Clause
#include "CReplaySensor.h"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CRawlog.h>
#include <salma/observations/CLogReader.h>
#include <salma/observations/loadPicture.h>
#include <salma/observations/registerClasses.h>

#include <atomic>
#include <chrono>
#include <stdexcept>

IMPLEMENTS_GENERIC_SENSOR(CReplaySensor, salma::test)

namespace salma::test {
namespace {

using TClock = std::chrono::steady_clock;

/// When the replay that goes on began: all sensors play from there.
std::atomic<TClock::time_point> replayStart{TClock::time_point()};

double stampOf(const mrpt::obs::CObservation& o) { return mrpt::Clock::toDouble(o.timestamp); }

}  // namespace

void CReplaySensor::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                              const std::string& section) {
    m_rawlog = file.read_string(section, "rawlog", "", true);
    m_label = file.read_string(section, "label", "", true);
    m_speed = file.read_double(section, "speed", 1);
    m_stampNow = file.read_string(section, "stamps", "log") == "now";
    m_failAtEnd = file.read_bool(section, "fail_at_end", false);
}

void CReplaySensor::initialize() {
    observations::registerClasses();
    mrpt::obs::CRawlog log;
    if (!log.loadFromRawLogFile(m_rawlog)) throw std::runtime_error(m_rawlog + ": cannot be read");
    m_logStart = stampOf(*log.getAsObservation(0));
    const std::string images = m_rawlog.substr(0, m_rawlog.rfind('.')) + "_Images";
    for (std::size_t i = 0; i < log.size(); ++i) {
        const auto o = log.getAsObservation(i);
        if (o->sensorLabel != m_label) continue;
        if (const auto picture = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(o))
            picture->image = mrpt::img::CImage(observations::loadPicture(*picture, images),
                                               mrpt::img::DEEP_COPY);
        m_observations.push_back(o);
    }
    replayStart = TClock::now();
}

void CReplaySensor::doProcess() {
    const double played =
        std::chrono::duration<double>(TClock::now() - replayStart.load()).count() * m_speed;
    for (; m_next < m_observations.size(); ++m_next) {
        const auto& o = m_observations[m_next];
        if (stampOf(*o) - m_logStart > played) return;
        if (m_stampNow) o->timestamp = mrpt::Clock::now();
        appendObservation(o);
    }
    if (m_failAtEnd) throw std::runtime_error("all was played");
}

}  // namespace salma::test
