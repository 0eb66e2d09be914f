// SPDX-License-Identifier: BSD-3-Clause
#include "CSlamApp.h"

#include <salma/landmarks/CLandmarkDatabase.h>
#include <salma/observations/CLogWriter.h>
#include <salma/observations/registerClasses.h>
#include <salma/slam/focalCheck.h>
#include <salma/viz/CRunWriter.h>
#include <salma/viz/CTrajectoryScore.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "CMapping.h"
#include "backend.h"

namespace fs = std::filesystem;

namespace salma::apps {
namespace {

std::size_t countOf(const observations::TLog& log, const std::string& name) {
    const auto found = log.counts.find(name);
    return found == log.counts.end() ? 0 : found->second;
}

/// X.gt.tum beside X.rawlog: the true path of a simulated log.
std::optional<viz::TTrajectory> truthOf(const std::string& rawlog) {
    const fs::path truth = fs::path(rawlog).replace_extension(".gt.tum");
    if (!fs::exists(truth)) return std::nullopt;
    return viz::readTum(truth.string());
}

}  // namespace

void CSlamApp::initialize(const TSlamArguments& arguments) {
    m_arguments = arguments;
    observations::registerClasses();
    m_config = TSlamConfig::load(arguments.config);
    if (!arguments.backend.empty()) setBackend(arguments.backend, m_config);
    if (!arguments.association.empty()) setMethod(arguments.association, m_config);
    if (arguments.seed >= 0) setSeed(arguments.seed, m_config);
    m_config.ekf.ignoreIdentities |= arguments.ignoreIdentities;
    m_out = std::make_unique<COutputFolder>(arguments.out);  // a bad place is found before the work
    if (m_arguments.rawlog.empty() && !m_config.run.rawlog.empty())
        m_arguments.rawlog =
            (fs::path(arguments.config).parent_path() / m_config.run.rawlog).string();
    if (m_arguments.rawlog.empty())
        throw std::invalid_argument("no rawlog: name one, or set rawlog in [run] of " +
                                    arguments.config);
    observations::TLogReaderOptions options;
    options.acceptTruncated = arguments.acceptTruncated;
    m_log = observations::readLog(m_arguments.rawlog, options);
    m_truth = truthOf(m_arguments.rawlog);
    m_record.logFile = m_arguments.rawlog;
    m_record.seed = static_cast<std::uint32_t>(m_config.lines.seed);
    m_record.options = m_config.asIni();
    noticeWhatIsMissing();
    noticeOfSpace();
}

void CSlamApp::notice(const std::string& text) {
    m_record.notices.push_back(text);
    std::cerr << "notice: " << text << "\n";
}

void CSlamApp::noticeWhatIsMissing() {
    const bool scans = countOf(m_log, "mrpt::obs::CObservation2DRangeScan") > 0;
    const bool pictures = countOf(m_log, "mrpt::obs::CObservationImage") > 0;
    const bool ranges = countOf(m_log, "mrpt::obs::CObservationBearingRange") > 0;
    const bool recorded = countOf(m_log, "salma::observations::CObservationSalientLandmarks") > 0;
    const auto missing = [&](bool there, const std::string& what, const std::string& effect) {
        if (there) return;
        if (m_arguments.require.count(what) != 0)
            throw std::runtime_error(m_log.file + ": holds no " + what + ", which is required");
        notice("no " + what + " in the log: " + effect);
    };
    missing(m_log.hasOdometry, "odometry", "the motion between steps is unknown");
    missing(scans, "laser", "no corners and no walls for pictures");
    missing(pictures || recorded, "pictures", "landmarks have no appearance");
    if (pictures && m_log.panTilt.empty())
        notice("no pan/tilt in the log: the pictures' own camera poses are used");
    if (m_log.truncated)
        notice("the log breaks off: last whole record at " + std::to_string(m_log.lastGoodTime) +
               " s");
    const bool corners = scans && m_config.run.corners;
    if (!ranges && !(m_log.hasOdometry && (recorded || corners || (scans && pictures))))
        throw std::runtime_error(m_log.file +
                                 ": no landmark source: neither laser with odometry nor "
                                 "range-bearing observations");
}

/// What a filter does with motion and sensors of another number of dimensions.
void CSlamApp::noticeOfSpace() {
    const auto& steps = m_log.steps;
    const bool spatial = std::any_of(steps.begin(), steps.end(), [](const auto& step) {
        return step.spatialIncrement.has_value();
    });
    if (!m_config.isSpatial()) {
        if (spatial) notice("odometry is in space: the filter in the plane sees it from above");
        return;
    }
    if (countOf(m_log, "mrpt::obs::CObservationBearingRange") == 0)
        throw std::runtime_error(m_log.file +
                                 ": state = 6d in [ekf] needs range-bearing observations");
    if (m_log.hasOdometry && !spatial)
        notice("odometry is in the plane: height, pitch and roll are taken to stay");
    if (m_log.counts.size() > 1)
        notice("of the sensors, a filter in space takes range-bearing alone");
}

void CSlamApp::noticeOfPictures(const TSeen& seen) {
    const auto some = [&](std::size_t count, const std::string& what) {
        if (count > 0)
            notice(std::to_string(count) + " of " + std::to_string(seen.pictures) + " pictures " +
                   what);
    };
    some(seen.filesMissing, "are missing: no file in " + m_log.imagesFolder);
    some(seen.withoutScan, "have no scan within max_skew_s");
    some(seen.withoutHeadPose, "have no pan/tilt record within max_skew_s");
    std::string reasons;
    for (const auto& [reason, count] : seen.refused)
        reasons += (reasons.empty() ? "" : ", ") + std::to_string(count) + " " + reason;
    if (!reasons.empty()) notice("not taken from pictures: " + reasons);
    if (m_arguments.require.count("pictures") != 0 && seen.filesMissing == seen.pictures &&
        seen.pictures > 0)
        throw std::runtime_error(m_log.imagesFolder + ": holds none of the log's pictures");
    m_record.refused = seen.refused;
    m_record.splitGroups = seen.split;
    m_record.pictures = seen.records.size();
    for (const auto& record : seen.records)
        if (record->landmarks.empty()) ++m_record.picturesWithoutLandmark;
}

void CSlamApp::noticeOfCalibration() {
    const auto check = slam::checkFocalLength(m_record);
    if (!check || !check->isWrong()) return;
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << "the focal length in the log seems to be "
         << 100 * std::abs(check->error) << " % (sigma " << 100 * check->sigma << " %) too "
         << (check->error > 0 ? "long" : "short") << ", by the bearings of " << check->sightings
         << " sightings of salient landmarks: check the camera's calibration";
    notice(text.str());
}

void CSlamApp::savePictureRecords(const TSeen& seen, const std::string& folder) const {
    const std::string name = fs::path(m_log.file).filename().string();
    if (m_arguments.embed)
        observations::saveEmbedded(m_log, seen.records, folder + "/" + name);
    else
        observations::saveCompanion(m_log, seen.records,
                                    folder + "/" + observations::companionOf(name));
}

void CSlamApp::writeDatabase(const std::string& file) const {
    std::vector<landmarks::TStoredLandmark> stored;
    for (const auto& l : m_record.landmarks) {
        landmarks::TStoredLandmark s;
        s.id = l.id;
        s.kind = viz::nameOf(l.kind);
        s.mean = l.mean;
        s.covariance = l.covariance;
        s.sightings = static_cast<int>(l.sightings);
        s.firstTime = l.firstTime;
        s.lastTime = l.lastTime;
        s.patch = l.patch;
        stored.push_back(s);
    }
    landmarks::CLandmarkDatabase(file).create(stored);
}

void CSlamApp::run() {
    const auto start = std::chrono::steady_clock::now();
    const COutputFolder& out = *m_out;

    const TSeen seen = CPictureWork(m_config, m_log).run();
    noticeOfPictures(seen);

    const auto backend = createBackend(m_config);
    CMapping(m_config, m_log, *backend).run(seen.records, m_record);
    if (m_record.trajectory.empty())
        throw std::runtime_error(m_log.file + ": nothing in it could be used for a step");
    noticeOfCalibration();
    m_record.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    viz::CRunWriter(out.path()).writeAll({m_record, m_truth});
    writeDatabase((out / "landmarks.db").string());
    if (m_arguments.saveRawlog) savePictureRecords(seen, out.path().string());
    m_out->publish();
}

std::string CSlamApp::accuracy() const {
    std::ostringstream text;
    const viz::CTrajectoryScore score;
    const auto error = [&](const viz::TTrajectory& path) {
        return score.compare(*m_truth, path).aligned.rmse;
    };
    try {
        text << std::fixed << std::setprecision(3) << "ATE " << error(viz::estimatedPath(m_record))
             << " m, odometry alone " << error(viz::odometryPath(m_record)) << " m\n";
    } catch (const std::invalid_argument& e) {  // the run is whole without it
        return std::string("not compared with the true path: ") + e.what() + "\n";
    }
    return text.str();
}

std::string CSlamApp::summary() const {
    std::ostringstream text;
    const auto counts = viz::countDecisions(m_record);
    const auto salient =
        std::count_if(m_record.landmarks.begin(), m_record.landmarks.end(),
                      [](const auto& l) { return l.kind == association::ELandmarkKind::salient; });
    text << m_record.trajectory.size() << " steps, " << salient << " salient landmarks, "
         << m_record.landmarks.size() - static_cast<std::size_t>(salient) << " corners; paired "
         << counts.paired << ", new " << counts.created << ", deferred " << counts.deferred
         << ", clutter " << counts.clutter << ", provisional " << counts.provisional << "\n";
    if (m_truth) text << accuracy();
    text << "report " << m_arguments.out << "/report.html\n";
    return text.str();
}

}  // namespace salma::apps
