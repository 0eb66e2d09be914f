// SPDX-License-Identifier: BSD-3-Clause
#include "writeModel.h"

#include <cstdio>
#include <string>

namespace salma::bench {
namespace {

constexpr std::size_t kLine = 96;

std::string asText(double value, const char* format) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Numbers separated by commas, in lines that are not too long.
class CNumbers {
 public:
    explicit CNumbers(std::ostream& out) : m_out(out) {}
    void add(const std::string& number) {
        if (m_used + number.size() + 1 > kLine) {
            m_out << '\n';
            m_used = 0;
        }
        m_out << number << ',';
        m_used += number.size() + 1;
    }

 private:
    std::ostream& m_out;
    std::size_t m_used{kLine};
};

void writeMatrix(const std::string& name, const laser::TPlaceMatrix& matrix, std::ostream& out) {
    out << "const TPlaceMatrix " << name << "{{";
    for (const auto& row : matrix) {
        out << "\n{{";
        for (const double p : row) out << asText(p, "%.5f") << (&p == &row.back() ? "" : ", ");
        out << "}},";
    }
    out << "\n}};\n\n";
}

}  // namespace

void writeModel(const laser::TPlaceNetwork& network,
                const laser::TPlaceTransitions& transitions,
                std::ostream& out) {
    out << "// SPDX-License-Identifier: BSD-3-Clause\n"
           "// Written by `place-classes train`; do not edit.\n"
           "#include \"placeModel.h\"\n\n"
           "// clang-format off\n"
           "namespace salma::laser {\n\n"
           "const std::vector<int> kPlaceLayers{"
        << network.layers.front().cols() - 1;
    for (const auto& layer : network.layers) out << ", " << layer.rows();
    out << "};\n\n";
    writeMatrix("kPlaceGoingOn", transitions.goingOn, out);
    writeMatrix("kPlaceTurning", transitions.turning, out);
    out << "const std::vector<float> kPlaceWeights{";
    CNumbers numbers(out);
    for (const auto& layer : network.layers)
        for (Eigen::Index i = 0; i < layer.size(); ++i)
            numbers.add(asText(static_cast<double>(layer.data()[i]), "%.4g"));
    out << "\n};\n\n}  // namespace salma::laser\n";
}

}  // namespace salma::bench
