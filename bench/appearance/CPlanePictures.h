// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <salma/appearance/CPatchDescriptor.h>
#include <salma/appearance/CRectifier.h>
#include <salma/appearance/CRegionDescriptor.h>

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace salma::bench {

using Corners = std::vector<mrpt::math::TPoint2D>;

/** Real pictures of one plane with the homographies between them, and the patches that the four
 * corners of a rectangle of the first picture give in each of them.
 *
 * Nobody measured the planes: the rectangle is taken to be 1 m high. Patches are described as those
 * of a robot are, from a view straight ahead of the rectified picture. */
class CPlanePictures {
 public:
    /** \param folder "graf", "boat" or "churchill" below SALMA_DATA_DIR/homography.
     * \throw std::runtime_error naming the file that cannot be read. */
    static CPlanePictures ofSet(const std::string& data, const std::string& folder);

    /// Picture k, from 0. \throw std::out_of_range
    const cv::Mat& picture(std::size_t k) const { return m_pictures.at(k); }
    std::size_t size() const { return m_pictures.size(); }

    /// Angle of a view of a plane whose front view is picture 0, at its middle: acos of the smaller
    /// over the larger singular value of the map's Jacobian [rad].
    double angle(std::size_t k) const;

    /// Largest rectangle of picture 0, of its aspect, that lies in picture k too [px of 0].
    Corners common(std::size_t k) const;
    /// Through the true map.
    Corners inPicture(const Corners& ofFirst, std::size_t k) const;

 private:
    std::vector<cv::Mat> m_pictures;  //!< CV_8UC1.
    std::vector<cv::Matx33d> m_maps;  //!< Picture 0 to picture k.
};

/// Points through a homography.
Corners mapped(const cv::Matx33d& H, const Corners& points);

/// The whole of a picture, its outer corners.
Corners whole(const cv::Mat& picture);

/** What four corners of a picture show, as a patch of 1 m height and the given aspect.
 * \return Nothing if the corners are no convex quadrilateral, or the rectifier refuses. */
std::optional<observations::TPatch> patchOf(const cv::Mat& grey,
                                            const Corners& corners,
                                            double aspect);

}  // namespace salma::bench
