// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/ellipseGeometry.h>
#include <salma/saliency/nonRedundantCount.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace salma::saliency {
namespace {

constexpr double kMostPixels = 1 << 26;

/// First and last pixel of a span; empty if last < first.
struct TSpan {
    int first{0};
    int last{-1};

    TSpan() = default;
    TSpan(double low, double high)
        : first(static_cast<int>(std::ceil(low))), last(static_cast<int>(std::floor(high))) {}
    int size() const { return std::max(0, last - first + 1); }
};

/// The window of a region.
class CMask {
 public:
    CMask(TEllipse region, double scale) : m_window(region) {
        m_window.a /= scale * scale;
        m_window.b /= scale * scale;
        m_window.c /= scale * scale;
        const cv::Size2d half = halfBox(m_window);
        left = m_window.u - half.width;
        right = m_window.u + half.width;
        top = m_window.v - half.height;
        bottom = m_window.v + half.height;
        if (!std::isfinite(left + right + top + bottom))
            throw std::invalid_argument("a region's window is not finite");
    }

    TSpan rows() const { return {top, bottom}; }

    TSpan columns(int row) const {
        const double dy = row - m_window.v;
        const double square = m_window.a - determinant() * dy * dy;
        if (!(square >= 0)) return {};
        const double middle = m_window.u - m_window.b * dy / m_window.a;
        const double half = std::sqrt(square) / m_window.a;
        return {middle - half, middle + half};
    }

    /// Puts exp(-q/2) of each pixel of a span at the end of `values`, q being 1 on the rim.
    void append(int row, const TSpan& columns, std::vector<double>& values) const {
        const double dx = columns.first - m_window.u;
        const double dy = row - m_window.v;
        const auto& [u, v, a, b, c] = m_window;
        // From pixel to pixel the exponent grows by a difference that grows by a constant.
        double value = std::exp(-(a * dx * dx + 2 * b * dx * dy + c * dy * dy) / 2);
        double ratio = std::exp(-(a * (2 * dx + 1) + 2 * b * dy) / 2);
        const double ratioOfRatios = std::exp(-a);
        for (int column = columns.first; column <= columns.last; ++column) {
            values.push_back(value);
            value *= ratio;
            ratio *= ratioOfRatios;
        }
    }

    double left{0}, right{0}, top{0}, bottom{0};  //!< The box around it [px].

 private:
    double determinant() const { return m_window.a * m_window.c - m_window.b * m_window.b; }

    TEllipse m_window;
};

/// The largest mask at each pixel.
class CCanvas {
 public:
    explicit CCanvas(const std::vector<CMask>& masks) {
        double left = masks[0].left;
        double right = masks[0].right;
        double top = masks[0].top;
        double bottom = masks[0].bottom;
        for (const auto& mask : masks) {
            left = std::min(left, mask.left);
            right = std::max(right, mask.right);
            top = std::min(top, mask.top);
            bottom = std::max(bottom, mask.bottom);
        }
        const double size = (right - left + 2) * (bottom - top + 2);
        if (!(size <= kMostPixels && std::max(-left, right) < 1e9 && std::max(-top, bottom) < 1e9))
            throw std::invalid_argument("the windows of the regions span too many pixels");
        m_columns = {std::floor(left), std::ceil(right)};
        m_firstRow = static_cast<int>(std::floor(top));
        const auto rows = static_cast<std::size_t>(std::ceil(bottom)) - m_firstRow + 1;
        m_largest.resize(rows * m_columns.size(), 0.0F);
    }

    void add(const CMask& mask) {
        m_values.clear();
        const TSpan rows = mask.rows();
        for (int row = rows.first; row <= rows.last; ++row)
            mask.append(row, mask.columns(row), m_values);
        double sum = 0;
        for (const double value : m_values) sum += value;
        if (m_values.empty()) return addPoint(mask);
        auto value = m_values.begin();
        for (int row = rows.first; row <= rows.last; ++row) {
            const TSpan columns = mask.columns(row);
            float* pixel = at(row, columns.first);
            for (int i = 0; i < columns.size(); ++i, ++pixel, ++value)
                *pixel = std::max(*pixel, static_cast<float>(*value / sum));
        }
    }

    double sum() const {
        double sum = 0;
        for (const float value : m_largest) sum += value;
        return sum;
    }

 private:
    /// A window between the pixels has its weight on one of them.
    void addPoint(const CMask& mask) {
        *at(static_cast<int>(std::floor((mask.top + mask.bottom) / 2)),
            static_cast<int>(std::floor((mask.left + mask.right) / 2))) = 1;
    }

    float* at(int row, int column) {
        return m_largest.data() + static_cast<std::size_t>(row - m_firstRow) * m_columns.size() +
               (column - m_columns.first);
    }

    TSpan m_columns;
    int m_firstRow{0};
    std::vector<float> m_largest;
    std::vector<double> m_values;  //!< Of the mask that is being added.
};

}  // namespace

double nonRedundantCount(const std::vector<TEllipse>& regions, double scale) {
    if (!(scale > 0)) throw std::invalid_argument("the scale of the windows must be positive");
    if (regions.empty()) return 0;
    std::vector<CMask> masks;
    masks.reserve(regions.size());
    for (const auto& region : regions) masks.emplace_back(region, scale);
    CCanvas canvas(masks);
    for (const auto& mask : masks) canvas.add(mask);
    return canvas.sum();
}

}  // namespace salma::saliency
