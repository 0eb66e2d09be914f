// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace salma::viz {

/// The style sheet of report.html.
inline constexpr auto kReportStyle = R"(
body{font:16px/1.45 system-ui,"DejaVu Sans",sans-serif;color:#222;background:#fff;
max-width:1180px;margin:2em auto;padding:0 1.2em}
h1{font-size:1.6em;margin:0 0 .6em}
h2{font-size:1.2em;margin:1.8em 0 .6em;border-bottom:1px solid #ddd;padding-bottom:.2em}
.tiles{display:flex;flex-wrap:wrap;gap:.6em}
.tile{background:#f4f5f7;border-radius:6px;padding:.5em .9em;min-width:5.2em}
.tile b{display:block;font-size:1.35em;font-variant-numeric:tabular-nums}
.tile span{color:#555;font-size:.85em}
.notices{background:#fff6e0;border-left:4px solid #e6a700;padding:.1em 1em .6em;margin-top:1.2em}
.notices h2{border:0;margin:.5em 0 .2em}
figure{margin:0}
figure img{width:100%;height:auto;border:1px solid #ddd}
figcaption{color:#555;font-size:.9em;margin-top:.3em}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:.35em .9em;text-align:right;border-bottom:1px solid #e5e5e5}
th:first-child,td:first-child{text-align:left}
thead th{background:#f4f5f7;font-weight:600}
.patch{height:88px;width:auto;max-width:180px;display:block;border:1px solid #ccc}
pre{background:#f4f5f7;padding:1em;overflow-x:auto;font-size:.85em}
summary{cursor:pointer}
@media print{details{display:block}body{margin:0}}
)";

}  // namespace salma::viz
