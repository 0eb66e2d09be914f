// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CRectifier.h>
#include <salma/appearance/CWallView.h>
#include <salma/simulator/CImageSensor.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <random>
#include <string>

namespace salma::bench {

/// What is drawn for each view, and how wrong laser, camera and border are.
struct TViewNoise {
    double extrinsics{mrpt::DEG2RAD(0.5)};  //!< Sigma of each angle of the camera [rad].
    double extrinsicsXyz{0.01};             //!< Sigma of each coordinate of the camera [m].
    double wallAngle{mrpt::DEG2RAD(0.5)};   //!< Sigma of the wall's angle [rad].
    double wallRho{0.01};                   //!< Sigma of the wall's distance [m].
    double pixel{1};                        //!< Sigma of a corner in the picture [px].
    double border{0.01};                    //!< Sigma of each side of the rectangle [m].
};

/// A picture of one poster, what is true, and what robot and laser believe.
struct TPosterView {
    cv::Mat grey;
    appearance::CWallView truth;
    appearance::CWallView seen;
    appearance::TWallRectangle place;  //!< Of the poster, in coordinates of `truth`.
    appearance::TWallRectangle cut;    //!< What is cut out, in coordinates of `seen`.
    mrpt::poses::CPose3D robot;        //!< T_w_r, as the world has it.
    double distance{0};                //!< From camera to poster [m].
    double incidence{0};               //!< Signed: positive from the poster's left [rad].
    int draws{1};                      //!< Views drawn until one showed the whole poster.
};

/** Draws views of one poster on a wall: distances of 1 to 6 m and up to 65 deg to either side,
 * evenly, of which those count that show the whole poster at 40 px/m or more. Rendered by the
 * simulator with its camera of 768x492 pixels and 48.8 deg. */
class CPosterViews {
 public:
    /// \param texture Picture file. \param wall Built-in texture of the simulator, or a file.
    CPosterViews(const std::string& texture,
                 const std::string& wall,
                 double height,
                 std::uint32_t seed);

    /** Views of a place in any scene whose wall y = 0 faces towards smaller y.
     * \param width, height Of the rectangle around (0, 0, kCentreHeight) that must be in view. */
    CPosterViews(const simulator::TWorld& scene, double width, double height, std::uint32_t seed);

    static constexpr double kCentreHeight = 1.45;  //!< Of the poster [m].

    TPosterView view(std::uint32_t index) const;

    TViewNoise noise;

 private:
    double m_width, m_height;
    std::uint32_t m_seed;
    simulator::TWorld m_description;
    simulator::CWorld m_world;
    simulator::CCameraModel m_camera;
    simulator::CRenderer m_renderer;
    simulator::CImageSensor m_sensor;
};

}  // namespace salma::bench
