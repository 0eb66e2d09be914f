// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CPatchDescriptor.h>
#include <salma/appearance/CRectifier.h>
#include <salma/appearance/CRegionDescriptor.h>
#include <salma/appearance/CTexture.h>
#include <salma/landmarks/CBorderFinder.h>
#include <salma/landmarks/CEntityDetector.h>
#include <salma/landmarks/CEntitySelector.h>
#include <salma/laser/TLine.h>
#include <salma/observations/CObservationSalientLandmarks.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace salma::landmarks {

/// Section [front_end] of config.ini.
struct TFrontEndOptions : public config::TStrictOptions<TFrontEndOptions> {
    int minKeypoints{12};     //!< Patches need as many: appearance::saysEnough().
    double minSize{0.2};      //!< Smallest width and height of an entity [m].
    double maxSize{2.5};      //!< Largest [m].
    double maxSkew{0.25};     //!< Longest gap between a picture and the scan it is joined with [s].
    double latencyCamera{0};  //!< Pictures were taken this long before their stamp [s].

    void visit(config::COptionVisitor& v);
    /// \throw std::invalid_argument
    void validate() const;
};

/// The options of all that a picture passes on its way to landmarks, one ini section each.
struct TSeeingOptions : public TDetectionOptions {
    TFrontEndOptions frontEnd;
    TBorderOptions border;
    appearance::TRectificationOptions rectification;
    appearance::TSecondLookOptions secondLook;
    appearance::TTextureOptions texture;
    appearance::TDescriptorOptions descriptor;
};

/// One picture, and what the laser and the robot say of it.
struct TView {
    cv::Mat grey;                     //!< CV_8UC1, as the camera delivers it.
    mrpt::img::TCamera camera;        //!< Of the picture's size.
    mrpt::poses::CPose3D T_r_c;       //!< At the picture's time.
    std::vector<laser::TLine> walls;  //!< Robot frame at the picture's time.
};

/// What was seen in a picture.
struct TFrontEndResult {
    std::vector<observations::TPatch> landmarks;
    /// Why regions, entities and whole pictures made no landmark, by reason, e.g. "no border".
    std::map<std::string, std::size_t> refused;
    std::size_t split{0};  //!< Groups of regions that lay on several planes and were split.
};

/** A picture and the walls around it to salient landmarks: the one way for simulator, file and
 * robot. It needs no pose of the robot in the world. Const is safe from several threads.
 * Source: K.-L. Ho, transfer report, Oxford 2004, sections 4.1.2 and 4.5. */
class CFrontEnd {
 public:
    /// \throw std::invalid_argument if options are out of range.
    explicit CFrontEnd(const TSeeingOptions& options = {});

    /// \throw std::invalid_argument if the picture is not CV_8UC1 or not of the camera's size.
    TFrontEndResult process(const TView& view) const;

    /// Pose in the robot frame of a landmark whose centre lies at (u, v) of the wall, as process()
    /// states it: place and covariance by laser, camera and border. The point must be visible.
    mrpt::poses::CPose3DPDFGaussian poseOnWall(const appearance::CWallView& wall,
                                               double u,
                                               double v) const;

    const TFrontEndOptions& options() const { return m_options; }

 private:
    std::optional<observations::TPatch> landmarkOf(const TEntity& entity,
                                                   const std::vector<appearance::CWallView>& walls,
                                                   const TView& view,
                                                   TFrontEndResult& result) const;
    std::optional<appearance::TWallRectangle> borderOf(const TEntity& entity,
                                                       const appearance::CWallView& wall,
                                                       const cv::Mat& grey) const;

    TFrontEndOptions m_options;
    CEntityDetector m_detector;
    CEntitySelector m_selector;
    CBorderFinder m_border;
    appearance::CRectifier m_rectifier;
    appearance::CRegionDescriptor m_secondLook;
    appearance::CTexture m_texture;
    appearance::CPatchDescriptor m_descriptor;
};

}  // namespace salma::landmarks
