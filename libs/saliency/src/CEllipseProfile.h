// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CScaleSaliency.h>
#include <salma/saliency/TEllipse.h>

#include <opencv2/core/mat.hpp>
#include <vector>

namespace salma::saliency {

/** Shape of an ellipse, whatever its size: half axes s sqrt(r) and s / sqrt(r), the longer one at
 * the angle theta from the picture's columns towards its rows. Written as a vector in which the
 * circle is a point like others, and a turn by 180 degrees is none. */
struct TEllipseShape {
    double cosine{0};  //!< log r cos 2 theta
    double sine{0};    //!< log r sin 2 theta

    /// log r
    double elongation() const;
    /// The ellipse of this shape about (u, v) whose half axes have the geometric mean s [px].
    TEllipse ellipse(double u, double v, double s) const;
};

/// A square cut out of the quantised picture, with its point of interest in the centre.
struct TSampledWindow {
    cv::Mat bins;            //!< [n x n], CV_8UC1, n odd.
    int samplesPerPixel{1};  //!< Along each side of a pixel of the picture.
};

/** Entropy and its change over the scales of one family of ellipses: concentric, of one shape, with
 * geometric mean radii scaleMin, scaleMin + 1... With one sample per pixel, the circle's family has
 * the discs of CScaleSaliency. */
class CEllipseProfile {
 public:
    explicit CEllipseProfile(const TScaleSaliencyOptions& options);

    /** Looks at the scales up to `sMax` [px], which is at least scaleMin + 2.
     * \param window Holds the ellipse of scale sMax. */
    void compute(const TSampledWindow& window, const TEllipseShape& shape, int sMax);

    /// The last family's peaks of entropy, ascending in scale; x and y are 0.
    const std::vector<observations::TSalientRegion>& peaks() const { return m_peaks; }

 private:
    void countSamples(const TSampledWindow& window, const TEllipse& unit, int sMax);
    void computeScale(int scale);
    void smooth();
    void findPeaks(int sMax);

    int* counts(int scale) {
        return m_counts.data() + static_cast<std::size_t>((scale - m_options.scaleMin) * m_bins);
    }

    TScaleSaliencyOptions m_options;
    int m_bins;
    std::vector<int> m_counts;         // [scales x bins]; first of the rings, then of the ellipses
    std::vector<double> m_proportion;  // of each bin in the last ellipse
    std::vector<double> m_entropy;     // by scale - scaleMin
    std::vector<double> m_change;      // sum |p(s) - p(s-1)|
    std::vector<observations::TSalientRegion> m_peaks;
};

}  // namespace salma::saliency
