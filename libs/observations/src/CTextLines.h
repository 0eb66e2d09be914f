// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/iostreams/filtering_stream.hpp>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace salma::observations {

/** Lines of a text file that may be packed with gzip or bzip2 (told by its first bytes). */
class CTextLines {
 public:
    /// \throw std::runtime_error "FILE: ..." if it is missing, a folder or cannot be read.
    explicit CTextLines(const std::string& file);

    /** The next line without its end, valid until the next call.
     * \return False at the end of the file.
     * \throw std::runtime_error if the file is damaged, the line too long, or not ended. */
    bool next(std::string_view& line);

    std::size_t number() const { return m_number; }  //!< Of the last line, from 1.

    /// \throw std::runtime_error "FILE: line N: what".
    [[noreturn]] void fail(const std::string& what) const;

 private:
    std::string m_file;
    boost::iostreams::filtering_istream m_stream;
    std::vector<char> m_buffer;
    std::size_t m_number{0};
};

}  // namespace salma::observations
