// SPDX-License-Identifier: BSD-3-Clause
#include <salma/sensing/CSourceSensor.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>
#include <utility>

namespace salma::sensing {
namespace {

using mrpt::hwdrivers::CGenericSensor;
using mrpt::obs::CObservation;

constexpr std::size_t kMostSeen = 10000;  // two minutes of a laser

CGenericSensor::Ptr create(const mrpt::config::CConfigFileBase& file, const std::string& section) {
    const auto fail = [&](const std::string& problem) {
        throw std::invalid_argument("section (" + section + ") " + problem);
    };
    if (!file.sectionExists(section)) fail("is not there");
    if (!file.read_bool(section, "rawlog-grabber-ignore", false))
        fail("needs rawlog-grabber-ignore = true: else rawlog-grabber opens its device as well");
    const std::string driver = file.read_string(section, "driver", "");
    auto sensor = CGenericSensor::createSensorPtr(driver);
    if (!sensor) fail("has driver = '" + driver + "', which is not known");
    sensor->loadConfig(file, section);
    if (!(sensor->getProcessRate() > 0)) fail("needs process_rate, more than 0");
    return sensor;
}

}  // namespace

CSourceSensor::CSourceSensor(const mrpt::config::CConfigFileBase& file, const std::string& section)
    : m_section(section), m_sensor(create(file, section)) {}

CSourceSensor::~CSourceSensor() {
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_stop = true;
    }
    m_news.notify_all();
    if (m_thread.joinable()) m_thread.join();
}

void CSourceSensor::initialize(const std::string& imagesFolder) {
    if (!imagesFolder.empty()) m_sensor->setPathForExternalImages(imagesFolder);
    m_sensor->initialize();
}

void CSourceSensor::run() {
    m_thread = std::thread([this] {
        try {
            loop();
        } catch (const std::exception& error) {
            collect();  // what it saw before it failed
            const std::lock_guard<std::mutex> lock(m_mutex);
            m_failure = error.what();
        }
    });
}

void CSourceSensor::loop() {
    const auto period = std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(1 / m_sensor->getProcessRate()));
    auto next = std::chrono::steady_clock::now();
    while (true) {
        m_sensor->doProcess();
        collect();
        next = std::max(next + period, std::chrono::steady_clock::now());  // no catching up
        std::unique_lock<std::mutex> lock(m_mutex);
        if (m_news.wait_until(lock, next, [this] { return m_stop; })) return;
    }
}

void CSourceSensor::collect() {
    const auto objects = m_sensor->getObservations();
    const std::lock_guard<std::mutex> lock(m_mutex);
    for (const auto& [time, object] : objects)
        if (auto observation = std::dynamic_pointer_cast<CObservation>(object))
            m_seen.push_back(std::move(observation));
    if (m_seen.size() <= kMostSeen) return;
    const auto excess = m_seen.size() - kMostSeen;
    m_seen.erase(m_seen.begin(), m_seen.begin() + static_cast<std::ptrdiff_t>(excess));
    m_lost += excess;
}

std::vector<CObservation::Ptr> CSourceSensor::take() {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return std::exchange(m_seen, {});
}

std::string CSourceSensor::failure() const {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_failure;
}

std::size_t CSourceSensor::lost() const {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_lost;
}

}  // namespace salma::sensing
