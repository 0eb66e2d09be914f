// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CMipMap.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace salma::simulator {

/// Paints or loads each texture once.
class CTextureStore {
 public:
    /// \param folder Files are named relative to it.
    explicit CTextureStore(std::filesystem::path folder);

    struct TTexture {
        std::shared_ptr<const CMipMap> map;
        double width{0};  //!< Of one tile [m]; 0 for a file, which does not say.
    };
    /// \throw std::runtime_error if a file cannot be read.
    const TTexture& get(const std::string& name, bool repeats);

 private:
    std::filesystem::path m_folder;
    std::map<std::pair<std::string, bool>, TTexture> m_textures;  //!< By name and repeats.
};

}  // namespace salma::simulator
