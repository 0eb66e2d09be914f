// SPDX-License-Identifier: BSD-3-Clause
#include "CRecordWriter.h"

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/system/datetime.h>
#include <runProgram.h>
#include <salma/observations/CLogReader.h>

#include <exception>

using mrpt::obs::CAction;
using mrpt::obs::CActionCollection;
using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservationOdometry;
using mrpt::serialization::CSerializable;

namespace salma::apps {
namespace {

constexpr std::size_t kLargeMember = 16U << 20;  // bytes; not to hold more in memory

bool isOfMrpt(const CSerializable& record) {
    return std::string(record.GetRuntimeClass()->className).compare(0, 6, "mrpt::") == 0;
}

}  // namespace

CRecordWriter::CRecordWriter(const std::string& log, const TOptions& options)
    : m_options(options), m_log(log, options.file) {}

std::uint64_t CRecordWriter::bytes() const {
    return m_log.bytes() + (m_companion ? m_companion->bytes() : 0);
}

void CRecordWriter::write(const CSerializable::Ptr& record) {
    ++m_records;
    CCaptureFile& file = fileFor(*record);
    const auto action = std::dynamic_pointer_cast<CAction>(record);
    if (m_options.sensoryFrames && &file == &m_log)
        writeToFrame(record);
    else if (action)
        writeAction(*action);
    else
        add(file, *record);
    if (file.waitingBytes() > kLargeMember) file.completeMember();
}

CCaptureFile& CRecordWriter::fileFor(const CSerializable& record) {
    if (m_options.embed || isOfMrpt(record)) return m_log;
    if (!m_companion)
        m_companion =
            std::make_unique<CCaptureFile>(observations::companionOf(m_log.file()), m_options.file);
    return *m_companion;
}

void CRecordWriter::add(CCaptureFile& file, const CSerializable& object) {
    try {
        file.add(object);
    } catch (const std::exception& error) {
        ++m_refused[std::string(object.GetRuntimeClass()->className) + ": " +
                    oneLine(error.what())];
    }
}

void CRecordWriter::writeToFrame(const CSerializable::Ptr& record) {
    if (const auto action = std::dynamic_pointer_cast<CAction>(record)) {
        writeFrame();
        writeAction(*action);
    } else if (const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(record)) {
        writeFrame();
        writeMovement(*odometry);
    } else if (const auto observation = std::dynamic_pointer_cast<CObservation>(record)) {
        const bool full =
            m_frame.size() > 0 &&
            mrpt::system::timeDifference(m_frame.getObservationByIndex(0)->timestamp,
                                         observation->timestamp) > m_options.frameTimeSpan;
        if (full) writeFrame();
        m_frame.insert(observation);
    }
}

void CRecordWriter::writeFrame() {
    // Empty ones too: readers of pairs take the frame behind each action.
    add(m_log, m_frame);
    m_frame.clear();
}

void CRecordWriter::writeAction(const CAction& action) {
    CActionCollection actions;
    actions.insert(action);
    add(m_log, actions);
}

void CRecordWriter::writeMovement(const CObservationOdometry& odometry) {
    const CObservationOdometry& last = m_lastOdometry ? *m_lastOdometry : odometry;
    CActionRobotMovement2D movement;
    movement.timestamp = odometry.timestamp;
    movement.computeFromOdometry(odometry.odometry - last.odometry,
                                 CActionRobotMovement2D::TMotionModelOptions());
    movement.hasEncodersInfo = odometry.hasEncodersInfo;
    movement.encoderLeftTicks = odometry.encoderLeftTicks - last.encoderLeftTicks;
    movement.encoderRightTicks = odometry.encoderRightTicks - last.encoderRightTicks;
    movement.hasVelocities = odometry.hasVelocities;
    movement.velocityLocal = odometry.velocityLocal;
    m_lastOdometry = odometry;
    writeAction(movement);
}

void CRecordWriter::completeMembers() {
    m_log.completeMember();
    if (m_companion) m_companion->completeMember();
}

void CRecordWriter::close() {
    if (m_frame.size() > 0) writeFrame();
    std::exception_ptr failure;
    for (CCaptureFile* file : {&m_log, m_companion.get()}) {
        try {
            if (file != nullptr) file->close();
        } catch (const std::exception&) {
            failure = std::current_exception();
        }
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace salma::apps
