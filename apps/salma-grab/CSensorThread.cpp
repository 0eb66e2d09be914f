// SPDX-License-Identifier: BSD-3-Clause
#include "CSensorThread.h"

#include <runProgram.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>

using mrpt::hwdrivers::CGenericSensor;

namespace salma::apps {
namespace {

std::chrono::steady_clock::duration seconds(double s) {
    return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(s));
}

}  // namespace

CSensorThread::CSensorThread(std::string section,
                             const mrpt::config::CConfigFileBase& file,
                             TSettings settings,
                             CPendingRecords& records)
    : m_section(std::move(section)),
      m_file(file),
      m_settings(std::move(settings)),
      m_records(records),
      m_sensor(make()),
      m_ownThreads(m_file.read_bool(m_section, "external_images_own_thread", false)) {}

CSensorThread::~CSensorThread() {
    stop();
    if (m_thread.joinable()) m_thread.join();
}

CGenericSensor::Ptr CSensorThread::make() const {
    const auto fail = [this](const std::string& problem) {
        throw std::invalid_argument("[" + m_section + "] " + problem);
    };
    const std::string driver = m_file.read_string(m_section, "driver", "");
    if (driver.empty()) fail("has no driver; rawlog-grabber-ignore = true if it is no sensor");
    CGenericSensor::Ptr sensor;
    try {
        sensor = CGenericSensor::createSensorPtr(driver);
        if (sensor) sensor->loadConfig(m_file, m_section);
    } catch (const std::exception& error) {
        fail(oneLine(error.what()));
    }
    if (!sensor) fail("driver = '" + driver + "' is not known; is its plug-in loaded (-p)?");
    if (!(sensor->getProcessRate() > 0)) fail("process_rate must be more than 0");
    return sensor;
}

void CSensorThread::start() {
    m_lastArrival = TSteady::now();
    setPhase(EPhase::starting);
    m_thread = std::thread([this] { run(); });
}

void CSensorThread::stop() {
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_stop = true;
    }
    m_stopped.notify_all();
}

bool CSensorThread::ended() const {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_status.phase == EPhase::ended || m_status.phase == EPhase::waiting;
}

CSensorThread::TStatus CSensorThread::status() const {
    const std::lock_guard<std::mutex> lock(m_mutex);
    TStatus status = m_status;
    status.age = std::chrono::duration<double>(TSteady::now() - m_lastArrival).count();
    return status;
}

void CSensorThread::run() {
    CGenericSensor::Ptr sensor = std::move(m_sensor);
    do {
        try {
            if (!sensor) sensor = make();
            work(*sensor);
        } catch (const std::exception& error) {
            noteFailure(oneLine(error.what()));
        } catch (...) {
            noteFailure("failed without saying why");
        }
        if (sensor) collectLate(*sensor);
        sensor.reset();  // closes the device
    } while (m_settings.restart && waitUntil(TSteady::now() + seconds(m_settings.restartTime)));
    setPhase(EPhase::ended);
}

void CSensorThread::work(CGenericSensor& sensor) {
    if (!m_settings.imagesFolder.empty()) sensor.setPathForExternalImages(m_settings.imagesFolder);
    sensor.initialize();
    noteWorking();
    const auto period = seconds(1 / sensor.getProcessRate());
    auto next = TSteady::now();
    do {
        sensor.doProcess();
        collect(sensor);
        next = std::max(next + period, TSteady::now());
    } while (waitUntil(next));
}

void CSensorThread::collect(CGenericSensor& sensor) {
    const auto records = sensor.getObservations();
    if (records.empty()) return;
    const auto now = TSteady::now();
    m_records.add(records, now);
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_status.records += records.size();
    m_lastArrival = now;
    const auto first = records.begin()->first;
    if (first < m_lastStamp) {
        ++m_status.backwards;
        m_status.worstStep = std::max(m_status.worstStep,
                                      std::chrono::duration<double>(m_lastStamp - first).count());
    }
    m_lastStamp = records.rbegin()->first;
}

void CSensorThread::collectLate(CGenericSensor& sensor) {
    collect(sensor);
    if (!m_ownThreads) return;
    // No way leads to the queues of those threads: they are done when nothing comes any more.
    constexpr auto kQuiet = std::chrono::milliseconds(500);
    constexpr auto kLook = std::chrono::milliseconds(20);
    for (auto last = TSteady::now(); TSteady::now() - last < kQuiet;) {
        const std::size_t before = status().records;
        std::this_thread::sleep_for(kLook);
        collect(sensor);
        if (status().records != before) last = TSteady::now();
    }
}

void CSensorThread::setPhase(EPhase phase) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_status.phase = phase;
}

void CSensorThread::noteWorking() {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_status.phase = EPhase::working;
    m_status.down = false;
    m_lastArrival = TSteady::now();
}

void CSensorThread::noteFailure(const std::string& problem) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    ++m_status.failures;
    m_status.down = true;
    m_status.problem = problem;
    m_status.phase = EPhase::failed;
}

bool CSensorThread::waitUntil(TSteady::time_point time) {
    std::unique_lock<std::mutex> lock(m_mutex);
    return !m_stopped.wait_until(lock, time, [this] { return m_stop; });
}

}  // namespace salma::apps
