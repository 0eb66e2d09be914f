// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/calibration/CTsaiGrid.h>

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>

namespace salma::apps {

class COutputFolder;

/** `salma-calib tsai IMAGE --square-m S --out DIR`: a camera from one photograph of two
 * checkerboards at a right angle. Adds its subcommand to an app and keeps what that was given. */
class CTsaiCommand {
 public:
    /// `app` may parse only while this object lives.
    explicit CTsaiCommand(CLI::App& app);
    CTsaiCommand(const CTsaiCommand&) = delete;
    CTsaiCommand& operator=(const CTsaiCommand&) = delete;

    bool isChosen() const { return m_command->parsed(); }

    /** Writes all files, or none if it fails; what was found to `out`.
     * \throw std::invalid_argument, std::runtime_error naming the file at fault. */
    void run(std::ostream& out);

 private:
    /// Points that were measured by other means, against the camera.
    struct TCheck {
        std::size_t points{0};
        int shift{0};   //!< [squares] Along the fold, from their origin to the grid's.
        double rms{0};  //!< [px]
    };

    TCheck check(const calibration::TTsaiResult& result) const;
    void writeResults(const COutputFolder& folder,
                      const cv::Mat& grey,
                      const calibration::TTsaiResult& result,
                      const std::string& summary) const;

    CLI::App* m_command;
    calibration::TTsaiOptions m_options;
    std::string m_image;
    double m_square{0};
    std::string m_check;
    double m_checkUnit{1};
    std::string m_out;
    std::string m_configFile;
    bool m_printConfig{false};
};

}  // namespace salma::apps
