// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/ellipseGeometry.h>
#include <salma/saliency/regionFiles.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace salma::saliency {
namespace {

constexpr auto kCsvHeader = "x_px,y_px,scale_px,entropy,interscale,saliency";

std::ofstream create(const std::string& file) {
    std::ofstream out(file, std::ios::binary);
    if (!out) throw std::runtime_error(file + ": cannot be written");
    return out;
}

void close(std::ofstream& out, const std::string& file) {
    out.close();
    if (!out) throw std::runtime_error(file + ": cannot be written to its end");
}

/// The lines of a file that are not blank, each cut into words, with their numbers for messages.
class CLines {
 public:
    explicit CLines(const std::string& file) : m_file(file), m_in(file, std::ios::binary) {
        if (!m_in) throw std::runtime_error(file + ": cannot be read");
    }

    /// False at the end of the file.
    bool next() {
        m_words.clear();
        while (m_words.empty() && std::getline(m_in, m_text)) {
            ++m_number;
            std::istringstream words(m_text);
            for (std::string word; words >> word;) m_words.push_back(word);
        }
        return !m_words.empty();
    }

    [[noreturn]] void fail(const std::string& problem) const {
        throw std::runtime_error(m_file + ":" + std::to_string(m_number) + ": " + problem);
    }

    /// The finite numbers of this line, of which there must be `count`.
    std::vector<double> numbers(std::size_t count) const {
        std::vector<double> values;
        for (const auto& word : m_words) {
            char* end = nullptr;
            values.push_back(std::strtod(word.c_str(), &end));
            if (end != word.c_str() + word.size() || !std::isfinite(values.back()))
                fail("'" + word.substr(0, 40) + "' is not a finite number");
        }
        if (values.size() != count)
            fail("expected " + std::to_string(count) + " numbers, got " +
                 std::to_string(values.size()));
        return values;
    }

 private:
    std::string m_file;
    std::ifstream m_in;
    std::string m_text;
    std::vector<std::string> m_words;
    std::size_t m_number{0};
};

/// The first lines of a region file.
struct TVggHeader {
    std::size_t descriptor{0};  //!< Numbers behind each ellipse.
    std::size_t count{0};
};

TVggHeader readHeader(CLines& lines, std::size_t most) {
    constexpr double kLongest = 1000;
    TVggHeader header;
    if (!lines.next()) lines.fail("file ends before the descriptor length 1.0");
    const double length = lines.numbers(1)[0];
    if (!(length >= 0 && length <= kLongest) || length != std::floor(length))
        lines.fail("descriptor length is not a whole number from 0 to 1000");
    if (length > 1) header.descriptor = static_cast<std::size_t>(length);
    if (!lines.next()) lines.fail("file ends before the number of regions");
    const double count = lines.numbers(1)[0];
    if (!(count >= 0 && count <= static_cast<double>(most)) || count != std::floor(count))
        lines.fail("number of regions is not a whole number from 0 to " + std::to_string(most));
    header.count = static_cast<std::size_t>(count);
    return header;
}

}  // namespace

void writeVgg(const std::string& file, const std::vector<TEllipse>& regions) {
    auto out = create(file);
    out << "1.0\n" << regions.size() << "\n" << std::setprecision(10);
    for (const auto& e : regions)
        out << e.u << " " << e.v << " " << e.a << " " << e.b << " " << e.c << "\n";
    close(out, file);
}

std::vector<TEllipse> readVgg(const std::string& file, std::size_t most) {
    CLines lines(file);
    const auto [descriptor, count] = readHeader(lines, most);
    std::vector<TEllipse> regions;
    while (lines.next()) {
        const auto n = lines.numbers(5 + descriptor);
        if (!(n[2] > 0 && n[2] * n[4] - n[3] * n[3] > 0)) lines.fail("a, b, c are not an ellipse");
        if (regions.size() == count)
            lines.fail("more regions than the " + std::to_string(count) + " announced");
        regions.push_back({n[0], n[1], n[2], n[3], n[4]});
    }
    if (regions.size() != count)
        lines.fail("file ends after " + std::to_string(regions.size()) + " of " +
                   std::to_string(count) + " regions");
    return regions;
}

cv::Matx33d readHomography(const std::string& file) {
    CLines lines(file);
    cv::Matx33d H;
    for (int row = 0; row < 3; ++row) {
        if (!lines.next()) lines.fail("file ends after " + std::to_string(row) + " of 3 rows");
        const auto values = lines.numbers(3);
        for (int column = 0; column < 3; ++column)
            H(row, column) = values[static_cast<std::size_t>(column)];
    }
    if (!isInvertible(H)) lines.fail("the matrix that ends here is singular");
    if (lines.next()) lines.fail("more than 3 rows");
    return H;
}

void writeRegionsCsv(const std::string& file,
                     const std::vector<observations::TSalientRegion>& regions) {
    auto out = create(file);
    out << kCsvHeader << "\n" << std::setprecision(10);
    for (const auto& r : regions)
        out << r.x << "," << r.y << "," << r.s << "," << r.H << "," << r.W << "," << r.Y << "\n";
    close(out, file);
}

void writeRegionsCsv(const std::string& file, const std::vector<TStableRegion>& regions) {
    auto out = create(file);
    out << kCsvHeader << ",area_px2,mean_grey,polarity\n" << std::setprecision(10);
    for (const auto& r : regions)
        out << r.ellipse.u << "," << r.ellipse.v << "," << r.ellipse.radius() << ",,,,"
            << r.pixels.size() << "," << r.meanGrey << ","
            << (r.polarity == EPolarity::darkOnBright ? "dark" : "bright") << "\n";
    close(out, file);
}

void writeQuadsCsv(const std::string& file, const std::vector<TQuad>& quads) {
    auto out = create(file);
    out << "x0_px,y0_px,x1_px,y1_px,x2_px,y2_px,x3_px,y3_px,area_px2\n" << std::setprecision(10);
    for (const auto& quad : quads) {
        for (const auto& corner : quad.corners) out << corner.x << "," << corner.y << ",";
        out << quad.area << "\n";
    }
    close(out, file);
}

}  // namespace salma::saliency
