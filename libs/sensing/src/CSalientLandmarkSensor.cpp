// SPDX-License-Identifier: BSD-3-Clause
#include <salma/config/withoutBrackets.h>
#include <salma/drivers/CPanTiltCameraSensor.h>
#include <salma/observations/readCamera.h>
#include <salma/sensing/CSalientLandmarkSensor.h>

#include <chrono>
#include <stdexcept>

IMPLEMENTS_GENERIC_SENSOR(CSalientLandmarkSensor, salma::sensing)

namespace salma::sensing {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationImage;
using mrpt::obs::CObservationOdometry;
using mrpt::poses::CPose2D;
using observations::CObservationPanTilt;

constexpr auto kBusy = "front end busy";

double steadyNow() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

const char* reasonOf(EFate fate) {
    switch (fate) {
        case EFate::noScan:
            return "no scan within max_skew_s";
        case EFate::noHeadPose:
            return "no pan/tilt within max_skew_s";
        case EFate::clockJumped:
            return "clock jumped back";
        case EFate::joined:
            break;
    }
    return "";
}

}  // namespace

CSalientLandmarkSensor::CSalientLandmarkSensor()
    : mrpt::system::COutputLogger("CSalientLandmarkSensor") {
    m_state = ssUninitialized;
    m_max_queue_len = static_cast<std::size_t>(m_options.maxQueue);  // where the section has none
}

CSalientLandmarkSensor::~CSalientLandmarkSensor() {
    if (!m_worker) return;
    m_sources.clear();
    report("at the end");
}

void CSalientLandmarkSensor::setPathForExternalImages(const std::string& directory) {
    m_imagesFolder = directory;
}

void CSalientLandmarkSensor::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                                       const std::string& section) {
    setLoggerName(section);
    try {
        load(file, section);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(config::withoutBrackets(error.what()));
    }
}

void CSalientLandmarkSensor::load(const mrpt::config::CConfigFileBase& file,
                                  const std::string& section) {
    m_options.loadFromConfigFile(file, section);
    if (!m_options.config.empty()) m_config = TSensingConfig::load(m_options.config);
    if (!m_options.cameraParams.empty())
        m_camera = observations::readCamera(m_options.cameraParams);
    std::set<std::string> sections{m_options.camera, m_options.laser, m_options.head,
                                   m_options.odometry};
    sections.erase("");
    m_sources.clear();
    for (const auto& name : sections)
        m_sources.push_back(std::make_unique<CSourceSensor>(file, name));
    // Made here already, so that options out of range are told before a device is opened.
    landmarks::CLandmarkRecorder{m_config.recorder};
    m_attention.reset();
    if (m_options.attention.use) createAttention();
}

void CSalientLandmarkSensor::createAttention() {
    for (auto& source : m_sources)
        if (source->section() == m_options.head)
            m_head = dynamic_cast<drivers::CPanTiltCameraSensor*>(&source->sensor());
    if (m_head == nullptr)
        throw std::invalid_argument("attend needs a head that can be turned: section (" +
                                    m_options.head + ") with driver = CPanTiltCameraSensor");
    const auto& camera = m_head->options().camera;
    if (!(m_options.attention.speed <= camera.panMaxSpeed))
        throw std::invalid_argument("attend_speed_deg is more than the head can do");
    const auto matcher =
        std::make_shared<const appearance::CPatchMatcher>(m_config.matcher, m_config.regionMatcher);
    m_attention.emplace(m_options.attention,
                        TGazeLimits{camera.panMin, camera.panMax, camera.tiltMin, camera.tiltMax},
                        m_config.tracking,
                        [matcher](const observations::TPatch& a, const observations::TPatch& b) {
                            return matcher->match(a, b).logLikelihoodRatio;
                        });
}

void CSalientLandmarkSensor::initialize() {
    m_state = ssInitializing;
    for (auto& source : m_sources) source->initialize(m_imagesFolder);
    const auto& frontEnd = m_config.recorder.seeing.frontEnd;
    m_queue = std::make_unique<CJoinQueue>(
        TJoinQueueOptions{!m_options.head.empty(), !m_options.odometry.empty(), frontEnd.maxSkew,
                          frontEnd.latencyCamera, m_options.wait});
    m_worker = std::make_unique<CFrontEndWorker>(m_config.recorder, m_imagesFolder,
                                                 static_cast<std::size_t>(m_options.threads));
    for (auto& source : m_sources) source->run();
    m_nextReport = steadyNow() + m_options.report;
    m_state = ssWorking;
}

void CSalientLandmarkSensor::doProcess() {
    collect();
    handOver();
    handOn();
    if (m_attention) lookAround();
    if (m_options.report > 0 && steadyNow() >= m_nextReport) {
        report("so far");
        m_nextReport = steadyNow() + m_options.report;
    }
    throwIfSourceFailed();
}

void CSalientLandmarkSensor::collect() {
    for (auto& source : m_sources)
        for (const auto& observation : source->take()) sort(observation, source->section());
    if (m_queue->jumps() == m_jumpsTold) return;
    m_jumpsTold = m_queue->jumps();
    MRPT_LOG_WARN("the clock jumped back; what was seen before that is not joined with pictures");
}

/// To the queue what it wants, and to the grabber all but pictures, which follow with their pose.
void CSalientLandmarkSensor::sort(const CObservation::Ptr& observation,
                                  const std::string& section) {
    const auto is = [&](const std::string& role) { return section == role; };
    if (const auto picture = std::dynamic_pointer_cast<CObservationImage>(observation);
        picture && is(m_options.camera)) {
        if (m_camera) picture->cameraParams = *m_camera;
        ++m_counts.pictures;
        return m_queue->add(picture, steadyNow());
    }
    appendObservation(observation);
    if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation);
        scan && is(m_options.laser))
        m_queue->add(scan);
    if (const auto state = std::dynamic_pointer_cast<CObservationPanTilt>(observation);
        state && is(m_options.head))
        m_queue->add(state);
    if (const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation);
        odometry && is(m_options.odometry))
        m_queue->add(odometry);
}

/// Pictures that wait no longer, to the grabber and to the front end.
void CSalientLandmarkSensor::handOver() {
    for (auto& decided : m_queue->take(steadyNow())) {
        auto& picture = *decided.job.picture;
        const bool joined = decided.fate == EFate::joined;
        if (joined && !m_options.head.empty()) picture.setSensorPose(decided.job.T_r_c);
        appendObservation(decided.job.picture);
        if (!joined)
            drop(reasonOf(decided.fate));
        else if (!m_worker->offer(std::move(decided)))
            drop(kBusy);
    }
}

/// Records that the front end has finished, to the grabber.
void CSalientLandmarkSensor::handOn() {
    for (const auto& worked : m_worker->take()) {
        const auto& record = worked.recorded.record;
        if (!record) {
            drop("bad picture", worked.error);
            continue;
        }
        if (!m_options.sensorLabel.empty()) record->sensorLabel = m_options.sensorLabel;
        ++m_counts.records;
        m_counts.landmarks += record->landmarks.size();
        appendObservation(record);
        if (m_attention)
            m_attention->see(*record, worked.picture.T_o_r.value_or(CPose2D()), steadyNow());
    }
}

/// Turns the head to what is to be seen again.
void CSalientLandmarkSensor::lookAround() {
    if (!m_queue->head()) return;
    const auto gaze =
        m_attention->gaze(m_queue->robot().value_or(CPose2D()), *m_queue->head(), steadyNow());
    if (gaze) m_head->pointTo(gaze->pan, gaze->tilt, m_options.attention.speed);
}

/// \param detail Told once; no more than a few different ones are.
void CSalientLandmarkSensor::drop(const std::string& reason, const std::string& detail) {
    constexpr std::size_t kMostTold = 20;
    ++m_counts.dropped[reason];
    const std::string text = reason + (detail.empty() ? "" : ": " + detail);
    if (m_told.size() < kMostTold && m_told.insert(text).second)
        MRPT_LOG_WARN_STREAM("picture dropped: " << text);
}

void CSalientLandmarkSensor::report(const std::string& when) {
    std::size_t dropped = 0;
    std::string reasons;
    for (const auto& [reason, count] : m_counts.dropped) {
        dropped += count;
        reasons += (reasons.empty() ? ": " : ", ") + std::to_string(count) + " " + reason;
    }
    MRPT_LOG_INFO_STREAM(m_counts.pictures << " pictures " << when << ", " << m_counts.records
                                           << " records with " << m_counts.landmarks
                                           << " landmarks, " << dropped << " pictures dropped"
                                           << reasons);
    if (m_attention)
        MRPT_LOG_INFO_STREAM("looked at until confirmed: " << m_attention->confirmed()
                                                           << ", let go: " << m_attention->letGo());
    for (const auto& source : m_sources)
        if (source->lost() > 0)
            MRPT_LOG_WARN_STREAM(source->lost() << " observations of " << source->section()
                                                << " were lost: the grabber did not take them");
}

void CSalientLandmarkSensor::throwIfSourceFailed() {
    for (const auto& source : m_sources) {
        const std::string failure = source->failure();
        if (failure.empty()) continue;
        m_state = ssError;
        if (m_queue->empty() && m_worker->isIdle())
            throw std::runtime_error("section (" + source->section() +
                                     "): " + config::withoutBrackets(failure));
    }
}

}  // namespace salma::sensing
