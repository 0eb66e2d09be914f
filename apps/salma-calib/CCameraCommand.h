// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/calibration/CCameraCalibrator.h>

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>

#include "TBoardArguments.h"

namespace salma::apps {

class COutputFolder;

/** `salma-calib camera IMAGE... --board CxR --square-m S --out DIR`: intrinsics and distortion from
 * pictures of a board. Adds its subcommand to an app and keeps what that was given. */
class CCameraCommand {
 public:
    /// `app` may parse only while this object lives.
    explicit CCameraCommand(CLI::App& app);
    CCameraCommand(const CCameraCommand&) = delete;
    CCameraCommand& operator=(const CCameraCommand&) = delete;

    bool isChosen() const { return m_command->parsed(); }

    /** Writes all files, or none if it fails; what was found to `out`.
     * \throw std::invalid_argument, std::runtime_error naming the file at fault. */
    void run(std::ostream& out);

 private:
    void writeResults(const COutputFolder& folder,
                      const TSeenBoards& seen,
                      const calibration::TCameraCalibration& result) const;
    void writeReport(const COutputFolder& folder,
                     const TSeenBoards& seen,
                     const calibration::TCameraCalibration& result) const;

    CLI::App* m_command;
    TBoardArguments m_board;
    calibration::TCameraCalibrationOptions m_options;
    std::string m_out;
    std::string m_configFile;
    bool m_printConfig{false};
};

}  // namespace salma::apps
