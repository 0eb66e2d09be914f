// SPDX-License-Identifier: BSD-3-Clause
#include "CTextureStore.h"

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "textures.h"

namespace salma::simulator {

CTextureStore::CTextureStore(std::filesystem::path folder) : m_folder(std::move(folder)) {}

const CTextureStore::TTexture& CTextureStore::get(const std::string& name, bool repeats) {
    TTexture& found = m_textures[{name, repeats}];
    if (found.map) return found;
    cv::Mat picture;
    if (isBuiltInTexture(name)) {
        const TBuiltInTexture painted = paintTexture(name);
        picture = painted.picture;
        found.width = painted.width;
    } else {
        const auto file = m_folder / name;
        picture = cv::imread(file.string(), cv::IMREAD_COLOR);
        if (picture.empty()) throw std::runtime_error(file.string() + ": cannot be read");
    }
    found.map = std::make_shared<CMipMap>(picture, repeats);
    return found;
}

}  // namespace salma::simulator
