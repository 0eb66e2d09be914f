// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "CCaptureFile.h"

namespace salma::apps {

/** Records to the log and its companion.
 *
 * Classes that are not MRPT's go to X.salient.rawlog, which is made when the first one comes; stock
 * programs could not read X.rawlog past such a record. With sensory frames the log holds an action
 * for each odometry reading, as rawlog-grabber writes it, and frames; here the first reading counts
 * as well, and so does the last frame. */
class CRecordWriter {
 public:
    struct TOptions {
        CCaptureFile::TOptions file;
        bool embed{false};  //!< All records into the one file.
        bool sensoryFrames{false};
        double frameTimeSpan{0.25};  //!< [s]
    };

    /// \throw std::runtime_error naming the file that cannot be made.
    CRecordWriter(const std::string& log, const TOptions& options);

    /// \throw std::runtime_error if the disk refuses.
    void write(const mrpt::serialization::CSerializable::Ptr& record);
    /// \throw std::runtime_error naming the file and the cause.
    void completeMembers();
    /// Writes what waits, and waits for the disk. Both files are tried. \throw std::runtime_error
    void close();

    std::size_t records() const { return m_records; }  //!< That were given to write().
    std::uint64_t bytes() const;                       //!< Of both files.
    const CCaptureFile& log() const { return m_log; }
    const CCaptureFile* companion() const { return m_companion.get(); }
    /// Records that could not be turned to bytes, by reason.
    const std::map<std::string, std::size_t>& refused() const { return m_refused; }

 private:
    void writeToFrame(const mrpt::serialization::CSerializable::Ptr& record);
    void writeFrame();
    void writeAction(const mrpt::obs::CAction& action);
    void writeMovement(const mrpt::obs::CObservationOdometry& odometry);
    CCaptureFile& fileFor(const mrpt::serialization::CSerializable& record);
    void add(CCaptureFile& file, const mrpt::serialization::CSerializable& object);

    TOptions m_options;
    CCaptureFile m_log;
    std::unique_ptr<CCaptureFile> m_companion;
    mrpt::obs::CSensoryFrame m_frame;
    std::optional<mrpt::obs::CObservationOdometry> m_lastOdometry;
    std::size_t m_records{0};
    std::map<std::string, std::size_t> m_refused;
};

}  // namespace salma::apps
