// SPDX-License-Identifier: BSD-3-Clause
#include "CCapture.h"

#include <mrpt/core/format.h>
#include <mrpt/obs/CObservationImage.h>
#include <salma/observations/CLogReader.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <utility>

namespace fs = std::filesystem;
using mrpt::obs::CObservationImage;

namespace salma::apps {
namespace {

constexpr auto kTick = std::chrono::milliseconds(50);

CPendingRecords::TTime before(double seconds) {
    return CPendingRecords::TTime::clock::now() -
           std::chrono::duration_cast<CPendingRecords::TTime::duration>(
               std::chrono::duration<double>(seconds));
}

std::string imagesFolderOf(const std::string& log) {
    return fs::path(log).replace_extension().string() + "_Images";
}

CRecordWriter::TOptions writerOptions(const CCapture::TSettings& settings) {
    CRecordWriter::TOptions options;
    options.file.compression = settings.global.compression;
    options.file.overwrite = settings.overwrite;
    options.file.syncWholeFileSystem = settings.grab.externalPictures;
    options.embed = settings.embed;
    options.sensoryFrames = settings.global.sensoryFrames;
    options.frameTimeSpan = settings.global.frameTimeSpan;
    return options;
}

/// Old pictures and an old companion would be taken for the new log's. \return `log`
const std::string& checkPlace(const std::string& log, bool overwrite) {
    const std::string images = imagesFolderOf(log);
    const std::string companion = observations::companionOf(log);
    std::error_code error;
    if (!overwrite && fs::exists(images, error) && !fs::is_empty(images, error))
        throw std::runtime_error(images + ": exists; --overwrite would replace it");
    if (!overwrite && fs::exists(companion, error))
        throw std::runtime_error(companion + ": exists; --overwrite would replace it");
    return log;
}

void removeOld(const std::string& log) {
    std::error_code ignored;
    fs::remove(observations::companionOf(log), ignored);
    fs::remove_all(imagesFolderOf(log), ignored);
}

}  // namespace

CCapture::CCapture(const mrpt::config::CConfigFileBase& file, TSettings settings)
    : m_settings(std::move(settings)),
      m_imagesFolder(imagesFolderOf(m_settings.log)),
      m_pictures(m_imagesFolder, [this](const std::string& line) { m_display.tell(line); }),
      m_sensors(makeSensors(file)),
      m_writer(checkPlace(m_settings.log, m_settings.overwrite), writerOptions(m_settings)) {
    if (m_settings.overwrite) removeOld(m_settings.log);
}

CCapture::~CCapture() = default;

CCaptureDisplay::TSensors CCapture::makeSensors(const mrpt::config::CConfigFileBase& file) {
    CSensorThread::TSettings settings;
    if (m_settings.grab.externalPictures) settings.imagesFolder = m_imagesFolder;
    settings.restart = m_settings.grab.onFailure == EOnFailure::restart;
    settings.restartTime = m_settings.grab.restartTime;
    std::vector<std::string> sections;
    file.getAllSections(sections);
    CCaptureDisplay::TSensors sensors;
    for (const auto& section : sections) {
        const bool noSensor = section.empty() || section == "global" || section == "salma-grab" ||
                              file.read_bool(section, "rawlog-grabber-ignore", false);
        if (!noSensor)
            sensors.push_back(std::make_unique<CSensorThread>(section, file, settings, m_pending));
    }
    if (sensors.empty()) throw std::invalid_argument("the ini file names no sensor");
    return sensors;
}

void CCapture::run(CStopSignals& signals, std::ostream& out) {
    m_start = m_lastMember = TSteady::now();
    if (launch(signals))
        while (step(signals)) {
        }
    const auto hanging = end(signals);
    finishFiles();
    m_display.finish();
    report(out);
    out.flush();
    const std::string problem = problems(hanging);
    if (!hanging.empty()) {
        std::cerr << "salma-grab: " << problem << std::endl;
        std::_Exit(EXIT_FAILURE);
    }
    if (!problem.empty()) throw std::runtime_error(problem);
}

bool CCapture::launch(CStopSignals& signals) {
    for (const auto& sensor : m_sensors) {
        sensor->start();
        const auto next = TSteady::now() + std::chrono::milliseconds(m_settings.global.launchPause);
        while (&sensor != &m_sensors.back() && TSteady::now() < next)
            if (!step(signals)) return false;
    }
    return true;
}

bool CCapture::step(CStopSignals& signals) {
    const auto signal = signals.wait(kTick);
    write(m_pending.take(before(m_settings.grab.holdTime)));
    completeMembersIfDue();
    m_display.update(m_sensors, m_writer.bytes());
    const double elapsed = std::chrono::duration<double>(TSteady::now() - m_start).count();
    if (signal)
        m_endedBy = *signal;
    else if (m_settings.duration > 0 && elapsed >= m_settings.duration)
        m_endedBy = "--duration";
    else if (!m_writeProblem.empty())
        m_endedBy = "a failed write";
    else if (!watchSensors())
        m_endedBy = "its sensors";
    return m_endedBy.empty();
}

bool CCapture::watchSensors() {
    bool goesOn = false, failure = false;
    for (const auto& sensor : m_sensors) {
        const auto status = sensor->status();
        if (status.failures > m_toldFailures[sensor.get()]) {
            m_display.tell(sensor->section() + " failed: " + status.problem);
            m_toldFailures[sensor.get()] = status.failures;
        }
        if (status.backwards > 0 && m_toldBackwards.insert(sensor.get()).second)
            m_display.tell(mrpt::format("%s: its clock jumped back by %.3f s",
                                        sensor->section().c_str(), status.worstStep));
        const bool silent = status.phase == CSensorThread::EPhase::working &&
                            status.age > m_settings.grab.silentTime;
        if (silent && m_silent.insert(sensor.get()).second)
            m_display.tell(sensor->section() +
                           mrpt::format(": nothing for %.1f s", m_settings.grab.silentTime));
        if (!silent && m_silent.erase(sensor.get()) > 0 &&
            status.phase == CSensorThread::EPhase::working)
            m_display.tell(sensor->section() + ": gives records again");
        failure = failure || status.failures > 0;
        goesOn = goesOn || status.phase != CSensorThread::EPhase::ended;
    }
    return goesOn && !(failure && m_settings.grab.onFailure == EOnFailure::stop);
}

std::vector<std::string> CCapture::end(CStopSignals& signals) {
    for (const auto& sensor : m_sensors) sensor->stop();
    const auto limit =
        TSteady::now() + std::chrono::duration_cast<TSteady::duration>(
                             std::chrono::duration<double>(m_settings.grab.stopTime));
    const auto working = [this] {
        return std::any_of(m_sensors.begin(), m_sensors.end(),
                           [](const auto& sensor) { return !sensor->ended(); });
    };
    while (working() && TSteady::now() < limit) {
        signals.wait(std::chrono::milliseconds(10));  // a second Ctrl-C must not lose anything
        write(m_pending.take(before(m_settings.grab.holdTime)));
        completeMembersIfDue();
    }
    write(m_pending.takeAll());
    watchSensors();
    std::vector<std::string> hanging;
    for (const auto& sensor : m_sensors)
        if (!sensor->ended()) hanging.push_back(sensor->section());
    return hanging;
}

void CCapture::write(const std::vector<CPendingRecords::TRecord>& records) {
    for (const auto& record : records) {
        if (!m_writeProblem.empty()) return;
        if (m_settings.grab.checkPictures)
            if (const auto picture = std::dynamic_pointer_cast<CObservationImage>(record))
                m_pictures.look(*picture);
        try {
            m_writer.write(record);
        } catch (const std::exception& error) {
            m_writeProblem = error.what();
        }
    }
}

void CCapture::completeMembersIfDue() {
    if (!m_writeProblem.empty() || m_lastMember > before(m_settings.grab.memberTime)) return;
    m_lastMember = TSteady::now();
    try {
        m_writer.completeMembers();
    } catch (const std::exception& error) {
        m_writeProblem = error.what();
    }
}

void CCapture::finishFiles() {
    try {
        m_writer.close();
    } catch (const std::exception& error) {
        if (m_writeProblem.empty()) m_writeProblem = error.what();
    }
    std::error_code ignored;
    // Stock programs cannot read a log without a record.
    if (m_writer.log().objects() == 0) fs::remove(m_settings.log, ignored);
    if (fs::is_directory(m_imagesFolder, ignored) && fs::is_empty(m_imagesFolder, ignored))
        fs::remove(m_imagesFolder, ignored);
}

void CCapture::report(std::ostream& out) const {
    const double seconds = std::chrono::duration<double>(TSteady::now() - m_start).count();
    out << mrpt::format("ended by %s after %.1f s\n", m_endedBy.c_str(), seconds);
    for (const auto& sensor : m_sensors) {
        const auto status = sensor->status();
        out << "  " << sensor->section() << ": " << status.records << " records";
        if (status.backwards > 0)
            out << ", clock jumped back " << status.backwards << " times, "
                << mrpt::format("%.3f s at most", status.worstStep);
        if (status.failures > 0)
            out << ", failed " << status.failures << " times: " << status.problem;
        out << "\n";
    }
    for (const auto& [fault, count] : m_pictures.faults())
        out << "  pictures of " << fault << ": " << count << " of those looked at\n";
    for (const auto& [reason, count] : m_writer.refused())
        out << "  not written: " << count << " of " << reason << "\n";
    for (const CCaptureFile* file : {&m_writer.log(), m_writer.companion()})
        if (file != nullptr && file->objects() > 0)
            out << file->file() << ": " << file->objects() << " objects, "
                << mrpt::format("%.1f MB\n", static_cast<double>(file->bytes()) / 1e6);
}

std::string CCapture::problems(const std::vector<std::string>& hanging) const {
    std::string problem;
    const auto add = [&problem](const std::string& text) {
        problem += (problem.empty() ? "" : "; ") + text;
    };
    if (!m_writeProblem.empty()) add(m_writeProblem + "; the log ends with the last whole member");
    for (const auto& sensor : m_sensors)
        if (const auto status = sensor->status(); status.down)
            add(sensor->section() + " failed: " + status.problem);
    for (const auto& section : hanging) add(section + " does not end and was left behind");
    if (!m_writer.refused().empty()) add("records could not be written");
    if (problem.empty() && m_writer.records() == 0) add("no sensor gave a record");
    return problem;
}

}  // namespace salma::apps
