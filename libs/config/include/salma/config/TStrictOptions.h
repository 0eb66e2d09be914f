// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CLoadableOptions.h>
#include <salma/config/CRangeCheck.h>
#include <salma/config/CSectionWriter.h>
#include <salma/config/CStrictSection.h>

#include <sstream>

namespace salma::config {

/** Base of the options of one component, `struct TFooOptions : TStrictOptions<TFooOptions>`.
 *
 * DERIVED has defaults in its fields, a `void visit(COptionVisitor&)` that lists its keys, and may
 * hide `void validate() const` for what involves several keys (throws std::invalid_argument; begins
 * with checkRanges()). */
template <class DERIVED>
struct TStrictOptions : public mrpt::config::CLoadableOptions {
    /// All or nothing. \throw std::invalid_argument naming file, section, key and value.
    void loadFromConfigFile(const mrpt::config::CConfigFileBase& file,
                            const std::string& section) override {
        DERIVED loaded = self();
        CStrictSection ini(file, section);
        loaded.visit(ini);
        ini.rejectUnknownKeys();
        loaded.validate();
        static_cast<DERIVED&>(*this) = loaded;
    }

    /// The section with every key, as config.ini holds it.
    std::string asIni(const std::string& section) const {
        std::ostringstream out;
        CSectionWriter writer(out, section);
        DERIVED copy = self();
        copy.visit(writer);
        return out.str();
    }

    void dumpToTextStream(std::ostream& out) const override { out << asIni("options"); }

    void validate() const { checkRanges(); }

 protected:
    /// \throw std::invalid_argument naming the first key whose value is out of range.
    void checkRanges() const {
        CRangeCheck check;
        DERIVED copy = self();
        copy.visit(check);
    }

    const DERIVED& self() const { return static_cast<const DERIVED&>(*this); }
};

}  // namespace salma::config
