// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace salma::config {

/// Allowed values of a number, in the unit of its key.
struct TRange {
    double min{-std::numeric_limits<double>::infinity()};
    double max{std::numeric_limits<double>::infinity()};
    bool minOpen{false};  //!< The value must be larger than `min`, not equal.
    bool maxOpen{false};  //!< The value must be smaller than `max`, not equal.

    /// False for NaN and for infinities.
    bool contains(double value) const;
    /// As mathematicians write it: "[0, 1)", "(0, inf)".
    std::string asString() const;
};

inline TRange anyNumber() { return {}; }
inline TRange atLeast(double min) { return {min, std::numeric_limits<double>::infinity()}; }
inline TRange moreThan(double min) { return {min, std::numeric_limits<double>::infinity(), true}; }
inline TRange between(double min, double max) { return {min, max}; }
inline TRange insideOf(double min, double max) { return {min, max, true, true}; }

/** Walks over the keys of one ini section, in their order in config.ini.
 *
 * An options struct lists its keys once, in `visit(COptionVisitor&)`; reading a file, writing
 * config.ini and `--print-config` are visitors over that one list. A key that is not dimensionless
 * ends in its unit. `meaning` is the comment in config.ini: what it is, without default and range.
 */
class COptionVisitor {
 public:
    virtual ~COptionVisitor() = default;

    virtual void number(const std::string& key,
                        double& value,
                        const TRange& range,
                        const std::string& meaning) = 0;
    virtual void integer(const std::string& key,
                         int& value,
                         const TRange& range,
                         const std::string& meaning) = 0;
    virtual void flag(const std::string& key, bool& value, const std::string& meaning) = 0;
    virtual void text(const std::string& key, std::string& value, const std::string& meaning) = 0;

    /// Value [rad] of a `key` that ends in "_deg"; `range` is in degrees.
    void degrees(const std::string& key,
                 double& radians,
                 const TRange& range,
                 const std::string& meaning);

    /// Numbers of unlimited count, separated by white space; `range` holds for each.
    virtual void numbers(const std::string& key,
                         std::vector<double>& values,
                         const TRange& range,
                         const std::string& meaning) = 0;

    /// One of the given names; `names` holds every value of the enumeration once.
    template <class ENUM>
    void choice(const std::string& key,
                ENUM& value,
                const std::vector<std::pair<std::string, ENUM>>& names,
                const std::string& meaning) {
        std::vector<std::string> words;
        std::size_t index = 0;
        for (std::size_t i = 0; i < names.size(); ++i) {
            words.push_back(names[i].first);
            if (names[i].second == value) index = i;
        }
        word(key, index, words, meaning);
        value = names[index].second;
    }

 protected:
    /// Index of one of `words`.
    virtual void word(const std::string& key,
                      std::size_t& index,
                      const std::vector<std::string>& words,
                      const std::string& meaning) = 0;
};

}  // namespace salma::config
