// SPDX-License-Identifier: BSD-3-Clause
#include <salma/simulator/CRenderer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace salma::simulator {

using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;

namespace {

constexpr double kNear = 0.02;  // nothing is drawn closer to the camera [m]
constexpr float kSeam = 1e-4f;  // faces are drawn larger by this so that none gapes [m]
constexpr int kSub = 4;         // samples along one side of a pixel on an edge
constexpr short kNothing = -1;
const cv::Vec3f kVoid(90, 90, 90);  // colour where a world has a hole

/// A face in the camera frame. With r = (x/z, y/z, 1): 1/z = q.r, u = (right.r) z - uShift.
struct TView {
    Vector3f q, right, up;
    float uShift, vShift;
    float u0, u1, v0, v1;
    const TFace* face;
    int firstRow, lastRow, firstColumn, lastColumn;  // that it can touch
    Vector3f a, b, c, d;  // none of their products with r is negative inside the rectangle
};

/// Corners of a face, cut off where they lie behind the camera.
std::vector<Vector3d> clipped(const std::array<Vector3d, 4>& corners) {
    std::vector<Vector3d> inside;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vector3d &p = corners[i], &next = corners[(i + 1) % 4];
        if (p.z() >= kNear) inside.push_back(p);
        if ((p.z() >= kNear) != (next.z() >= kNear))
            inside.push_back(p + (next - p) * ((kNear - p.z()) / (next.z() - p.z())));
    }
    return inside;
}

/// Share of [at - half, at + half] that lies in [low, high].
float covered(float at, float half, float low, float high) {
    const float overlap = std::min(at + half, high) - std::max(at - half, low);
    return std::clamp(overlap / (2 * half), 0.0f, 1.0f);
}

}  // namespace

class CRenderer::CFrame {
 public:
    CFrame(const CRenderer& renderer, const mrpt::poses::CPose3D& T_w_c);
    TRendering draw();

 private:
    void addView(const TFace& face);
    void fill(const TView& view, short id);
    Vector2f direction(int row, int column) const {
        return m_directions[static_cast<std::size_t>(row) * m_width +
                            static_cast<std::size_t>(column)];
    }
    Vector2f step(int row, int column, int down, int across) const;
    int candidates(int row, int column, std::array<short, 9>& ids) const;
    cv::Vec3f edgeColour(int row, int column, const std::array<short, 9>& ids, int count) const;
    cv::Vec3f shade(short id,
                    const Vector2f& at,
                    const Vector2f& across,
                    const Vector2f& down) const;
    Vector2f onFace(const TView& view, const Vector2f& at) const;
    float glare(const TFace& face, const Vector2f& at) const;

    const CRenderer& m_renderer;
    const std::vector<Vector2f>& m_directions;
    const std::size_t m_width;   // of the picture [px]
    Eigen::Matrix3d m_rotation;  // world to camera
    Vector3d m_position;         // of the camera in the world
    std::vector<TView> m_views;
    cv::Mat_<short> m_ids;
    TRendering m_result;
};

std::pair<int, int> CRenderer::touched(const std::vector<TBound>& bounds, float low, float high) {
    const auto touches = [&](const TBound& b) { return b.high >= low && b.low <= high; };
    const auto begin = std::find_if(bounds.begin(), bounds.end(), touches);
    const auto end = std::find_if(bounds.rbegin(), bounds.rend(), touches).base();
    return {static_cast<int>(begin - bounds.begin()), static_cast<int>(end - bounds.begin()) - 1};
}

CRenderer::CFrame::CFrame(const CRenderer& renderer, const mrpt::poses::CPose3D& T_w_c)
    : m_renderer(renderer),
      m_directions(renderer.m_camera.directions()),
      m_width(static_cast<std::size_t>(renderer.m_camera.columns())),
      m_rotation(T_w_c.getRotationMatrix().asEigen().transpose()),
      m_position(T_w_c.x(), T_w_c.y(), T_w_c.z()),
      m_ids(renderer.m_camera.rows(), renderer.m_camera.columns(), kNothing) {
    m_result.inverseDepth = cv::Mat_<float>(m_ids.size(), 0.0f);
    m_result.colour = cv::Mat_<cv::Vec3f>(m_ids.size());
    for (const auto& face : renderer.m_world.faces()) addView(face);
}

void CRenderer::CFrame::addView(const TFace& face) {
    const auto toCamera = [&](const Vector3d& p) -> Vector3d {
        return m_rotation * (p - m_position);
    };
    const auto polygon =
        clipped({toCamera(face.at(face.u0, face.v0)), toCamera(face.at(face.u1, face.v0)),
                 toCamera(face.at(face.u1, face.v1)), toCamera(face.at(face.u0, face.v1))});
    const Vector3d origin = toCamera(face.origin), normal = m_rotation * face.normal();
    const double distance = normal.dot(origin);
    if (polygon.empty() || std::abs(distance) < 1e-6) return;
    Eigen::AlignedBox2f box;
    for (const auto& p : polygon) box.extend(Vector2f((p.head<2>() / p.z()).cast<float>()));

    TView view;
    view.face = &face;
    std::tie(view.firstRow, view.lastRow) =
        touched(m_renderer.m_rowBounds, box.min().y(), box.max().y());
    std::tie(view.firstColumn, view.lastColumn) =
        touched(m_renderer.m_columnBounds, box.min().x(), box.max().x());
    if (view.firstRow > view.lastRow || view.firstColumn > view.lastColumn) return;
    view.q = (normal / distance).cast<float>();
    view.right = (m_rotation * face.right).cast<float>();
    view.up = (m_rotation * face.up).cast<float>();
    view.uShift = static_cast<float>((m_rotation * face.right).dot(origin));
    view.vShift = static_cast<float>((m_rotation * face.up).dot(origin));
    view.u0 = static_cast<float>(face.u0) - kSeam;
    view.u1 = static_cast<float>(face.u1) + kSeam;
    view.v0 = static_cast<float>(face.v0) - kSeam;
    view.v1 = static_cast<float>(face.v1) + kSeam;
    view.a = view.right - (view.uShift + view.u0) * view.q;
    view.b = (view.uShift + view.u1) * view.q - view.right;
    view.c = view.up - (view.vShift + view.v0) * view.q;
    view.d = (view.vShift + view.v1) * view.q - view.up;
    m_views.push_back(view);
}

void CRenderer::CFrame::fill(const TView& view, short id) {
    const auto dot = [](const Vector3f& f, const Vector2f& r) {
        return f[0] * r[0] + f[1] * r[1] + f[2];
    };
    for (int row = view.firstRow; row <= view.lastRow; ++row) {
        const Vector2f* directions = &m_directions[static_cast<std::size_t>(row) * m_width];
        float* depth = m_result.inverseDepth[row];
        short* ids = m_ids[row];
        for (int column = view.firstColumn; column <= view.lastColumn; ++column) {
            const Vector2f& r = directions[column];
            const float q = dot(view.q, r);
            if (q > depth[column] && dot(view.a, r) >= 0 && dot(view.b, r) >= 0 &&
                dot(view.c, r) >= 0 && dot(view.d, r) >= 0) {
                depth[column] = q;
                ids[column] = id;
            }
        }
    }
}

Vector2f CRenderer::CFrame::onFace(const TView& view, const Vector2f& at) const {
    const Vector3f r(at.x(), at.y(), 1);
    const float z = 1 / std::max(view.q.dot(r), 1e-4f);
    return {view.right.dot(r) * z - view.uShift, view.up.dot(r) * z - view.vShift};
}

/// Light of the lamps that a mirror at this place of a face would throw at the camera; white is 1.
float CRenderer::CFrame::glare(const TFace& face, const Vector2f& at) const {
    const Vector3d point = face.at(at.x(), at.y()), normal = face.normal();
    const Vector3d ray = (point - m_position).normalized();
    const Vector3d mirrored = ray - 2 * ray.dot(normal) * normal;
    double sum = 0;
    for (const auto& light : m_renderer.m_world.lights()) {
        const Vector3d towards = (light.position - point).normalized();
        const double angle = std::acos(std::clamp(mirrored.dot(towards), -1.0, 1.0));
        sum += light.brightness * std::exp(-0.5 * angle * angle / (light.width * light.width));
    }
    return static_cast<float>(sum);
}

cv::Vec3f CRenderer::CFrame::shade(short id,
                                   const Vector2f& at,
                                   const Vector2f& across,
                                   const Vector2f& down) const {
    if (id == kNothing) return kVoid;
    const TView& view = m_views[static_cast<std::size_t>(id)];
    const TSurface& surface = m_renderer.m_world.surfaces()[view.face->surface];
    const Vector2f p = onFace(view, at);
    const Vector2f a = onFace(view, at + across) - p, b = onFace(view, at + down) - p;
    const Vector2f half = (a.cwiseAbs() + b.cwiseAbs()) * 0.5f + Vector2f::Constant(1e-6f);
    const auto cover = [&](const TDecal& d) {
        return covered(p.x(), half.x(), float(d.u0), float(d.u1)) *
               covered(p.y(), half.y(), float(d.v0), float(d.v1));
    };
    const auto sample = [&](const CMipMap& texture, const Vector2f& corner, const Vector2f& size) {
        const Vector2f st = (p - corner).cwiseQuotient(size);
        const Vector2f da = a.cwiseQuotient(size), db = b.cwiseQuotient(size);
        return texture.sample({st.x(), 1 - st.y()}, {da.x(), -da.y()}, {db.x(), -db.y()});
    };
    auto decal = surface.decals.rbegin();  // what lies under an opaque one need not be drawn
    while (decal != surface.decals.rend() && !(cover(*decal) >= 1)) ++decal;
    cv::Vec3f colour(0, 0, 0);
    if (decal == surface.decals.rend()) {
        const float width = static_cast<float>(surface.textureWidth);
        const float height = width * static_cast<float>(surface.texture->rows()) /
                             static_cast<float>(surface.texture->columns());
        colour = sample(*surface.texture, Vector2f(0, 0), Vector2f(width, height));
    }
    float gleam = 0;
    for (auto d = decal == surface.decals.rend() ? surface.decals.begin() : decal.base() - 1;
         d != surface.decals.end(); ++d)
        if (const float share = cover(*d); share > 0) {
            gleam = gleam * (1 - share) + d->gloss * share;
            colour = colour * (1 - share) +
                     sample(*d->texture, Vector2f(float(d->u0), float(d->v0)),
                            Vector2f(float(d->u1 - d->u0), float(d->v1 - d->v0))) *
                         share;
        }
    float light = static_cast<float>(view.face->brightness);
    if (view.face->upright) light *= 1 - 0.14f * std::exp(-p.y() / 0.25f);  // dim along the floor
    colour *= light;
    if (gleam > 0) {
        const float white = 255 * gleam * glare(*view.face, p);
        colour += cv::Vec3f(white, white, white);
    }
    return colour;
}

Vector2f CRenderer::CFrame::step(int row, int column, int down, int across) const {
    const int back = (row + down < m_ids.rows && column + across < m_ids.cols) ? 0 : 1;
    const int y = row - back * down, x = column - back * across;
    return direction(y + down, x + across) - direction(y, x);
}

int CRenderer::CFrame::candidates(int row, int column, std::array<short, 9>& ids) const {
    int count = 0;
    for (int y = std::max(0, row - 1); y <= std::min(m_ids.rows - 1, row + 1); ++y)
        for (int x = std::max(0, column - 1); x <= std::min(m_ids.cols - 1, column + 1); ++x)
            if (std::find(ids.begin(), ids.begin() + count, m_ids(y, x)) == ids.begin() + count)
                ids[static_cast<std::size_t>(count++)] = m_ids(y, x);
    return count;
}

cv::Vec3f CRenderer::CFrame::edgeColour(int row,
                                        int column,
                                        const std::array<short, 9>& ids,
                                        int count) const {
    const Vector2f across = step(row, column, 0, 1), down = step(row, column, 1, 0);
    std::array<int, 9> hits{};
    std::array<Vector2f, 9> sum;
    sum.fill(Vector2f::Zero());
    for (int i = 0; i < kSub * kSub; ++i) {
        const int subRow = i / kSub, subColumn = i % kSub;
        const Vector2f at = direction(row, column) +
                            across * ((float(subColumn) + 0.5f) / kSub - 0.5f) +
                            down * ((float(subRow) + 0.5f) / kSub - 0.5f);
        const Vector3f r(at.x(), at.y(), 1);
        float nearest = 0;
        std::size_t best = 9;
        for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
            if (ids[k] == kNothing) continue;
            const TView& v = m_views[static_cast<std::size_t>(ids[k])];
            const float q = v.q.dot(r);
            if (q > nearest && v.a.dot(r) >= 0 && v.b.dot(r) >= 0 && v.c.dot(r) >= 0 &&
                v.d.dot(r) >= 0) {
                nearest = q;
                best = k;
            }
        }
        if (best == 9) continue;
        ++hits[best];
        sum[best] += at;
    }
    cv::Vec3f colour(0, 0, 0);
    int total = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        if (hits[k] == 0) continue;
        total += hits[k];
        colour += shade(ids[k], sum[k] / float(hits[k]), across, down) * float(hits[k]);
    }
    return total == 0 ? kVoid : colour * (1.0f / float(total));
}

TRendering CRenderer::CFrame::draw() {
    for (std::size_t i = 0; i < m_views.size(); ++i) fill(m_views[i], static_cast<short>(i));
    std::array<short, 9> ids{};
    for (int row = 0; row < m_ids.rows; ++row)
        for (int column = 0; column < m_ids.cols; ++column) {
            const int count = candidates(row, column, ids);
            m_result.colour(row, column) =
                count == 1 ? shade(ids[0], direction(row, column), step(row, column, 0, 1),
                                   step(row, column, 1, 0))
                           : edgeColour(row, column, ids, count);
        }
    return std::move(m_result);
}

CRenderer::CRenderer(const CWorld& world, const CCameraModel& camera)
    : m_world(world), m_camera(camera) {
    const TBound none{1e9f, -1e9f};
    m_rowBounds.assign(static_cast<std::size_t>(camera.rows()), none);
    m_columnBounds.assign(static_cast<std::size_t>(camera.columns()), none);
    const auto extend = [](TBound& bound, float value) {
        bound.low = std::min(bound.low, value - 1e-3f);  // half a pixel more for its border
        bound.high = std::max(bound.high, value + 1e-3f);
    };
    for (std::size_t i = 0; i < camera.directions().size(); ++i) {
        extend(m_rowBounds[i / m_columnBounds.size()], camera.directions()[i].y());
        extend(m_columnBounds[i % m_columnBounds.size()], camera.directions()[i].x());
    }
}

TRendering CRenderer::render(const mrpt::poses::CPose3D& T_w_c) const {
    return CFrame(*this, T_w_c).draw();
}

}  // namespace salma::simulator
