// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <chrono>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "CCaptureDisplay.h"
#include "CPendingRecords.h"
#include "CPictureWatch.h"
#include "CRecordWriter.h"
#include "CSensorThread.h"
#include "CStopSignals.h"
#include "TGrabOptions.h"

namespace salma::apps {

/** A capture from its first to its last record: sensors in their threads, their records in order
 * of time into the log, a gzip member every so often, and an end at which nothing is left behind.
 */
class CCapture {
 public:
    struct TSettings {
        TGlobalOptions global;
        TGrabOptions grab;
        std::string log;  //!< X.rawlog
        bool embed{false};
        bool overwrite{false};
        double duration{0};  //!< [s]; 0: until a signal comes.
    };

    /** Reads the sections of all sensors and makes the log.
     * \param file Must outlive this object.
     * \throw std::runtime_error, std::invalid_argument in one line */
    CCapture(const mrpt::config::CConfigFileBase& file, TSettings settings);
    ~CCapture();
    CCapture(const CCapture&) = delete;
    CCapture& operator=(const CCapture&) = delete;

    /** Until a signal, the duration, or the end of all sensors; then says what is in the files.
     * \throw std::runtime_error in one line if a sensor is down or the disk refused. What was
     * received is then in the log, but for what the disk refused. Ends the program by itself, with
     * exit code 1, if a sensor's thread does not end: nothing can be taken down under it. */
    void run(CStopSignals& signals, std::ostream& out);

 private:
    using TSteady = std::chrono::steady_clock;

    CCaptureDisplay::TSensors makeSensors(const mrpt::config::CConfigFileBase& file);
    /// Starts the sensors one after another. False if a signal came.
    bool launch(CStopSignals& signals);
    void record(CStopSignals& signals);
    /// One round: waits for a signal, writes what is due. False if the capture shall end.
    bool step(CStopSignals& signals);
    bool watchSensors();
    /// Tells the sensors to end and writes what they still give. Names those that do not end.
    std::vector<std::string> end(CStopSignals& signals);
    void write(const std::vector<CPendingRecords::TRecord>& records);
    void completeMembersIfDue();
    void finishFiles();
    void report(std::ostream& out) const;
    /// What went wrong, in one line; "" if nothing did.
    std::string problems(const std::vector<std::string>& hanging) const;

    TSettings m_settings;
    std::string m_imagesFolder;
    CPendingRecords m_pending;
    CCaptureDisplay m_display;
    CPictureWatch m_pictures;
    CCaptureDisplay::TSensors m_sensors;
    CRecordWriter m_writer;
    std::set<const CSensorThread*> m_silent, m_toldBackwards;
    std::map<const CSensorThread*, std::size_t> m_toldFailures;
    TSteady::time_point m_start, m_lastMember;
    std::string m_writeProblem;  //!< Why the disk refused; "" if it did not.
    std::string m_endedBy;
};

}  // namespace salma::apps
