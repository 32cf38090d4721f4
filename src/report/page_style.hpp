#pragma once
// The look of the page, on screen and on paper.

namespace zlg::report {

inline constexpr const char* page_style = R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2rem 1.5rem 4rem; max-width: 1000px; background: #fff; color: #111;
  font: 17px/1.5 Georgia, "Times New Roman", serif; overflow-wrap: break-word; }
h1, h2, nav, figcaption, table { font-family: Helvetica, Arial, sans-serif; }
h1 { margin: 0 0 .6rem; font-size: 1.75rem; line-height: 1.2; }
h2 { margin: 2.6rem 0 .6rem; padding-top: .7rem; border-top: 1px solid #bbb; font-size: 1.25rem; line-height: 1.3; }
p { margin: 0 0 .8rem; max-width: 44rem; }
.lead { font-size: 1.1rem; color: #333; }
nav ol { margin: 1.2rem 0 0; padding: .7rem 1rem .7rem 2.4rem; border-left: 3px solid #0072b2; background: #f5f7f9;
  font-size: .95rem; line-height: 1.6; }
a { color: #005a8d; }
figure { margin: 1.6rem 0; }
figcaption { max-width: 48rem; font-size: .88rem; line-height: 1.45; color: #333; }
figure.drawing { max-width: 780px; }
figure.drawing svg { display: block; width: 100%; height: auto; }
figure.drawing figcaption { margin-top: .4rem; }
figure.table figcaption { margin-bottom: .4rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .88rem; line-height: 1.35; font-variant-numeric: tabular-nums;
  border-top: 2px solid #111; border-bottom: 2px solid #111; }
th, td { padding: .35rem .7rem; text-align: right; vertical-align: bottom; overflow-wrap: normal; }
td { white-space: nowrap; vertical-align: top; }
th:first-child, td:first-child { padding-left: .2rem; text-align: left; white-space: normal; min-width: 7rem; }
thead th { border-bottom: 1px solid #111; }
tbody tr + tr > * { border-top: 1px solid #ddd; }
tbody th { font-weight: normal; }
table.prose th, table.prose td { min-width: 5rem; text-align: left; vertical-align: top; white-space: normal; }
table.prose td:last-child { min-width: 16rem; }
@media (max-width: 600px) {
  body { padding: 1rem 10px 3rem; font-size: 16px; }
  h1 { font-size: 1.45rem; }
}
@media print {
  @page { margin: 16mm; }
  body { max-width: none; padding: 0; font-size: 10.5pt; }
  h1 { font-size: 18pt; }
  h2 { margin-top: 1.4rem; font-size: 13pt; break-after: avoid; }
  .lead { font-size: 11.5pt; }
  figure, tr, nav { break-inside: avoid; }
  figure.drawing { max-width: 150mm; }
  figure.table { break-inside: auto; }
  figure.table figcaption { break-after: avoid; }
  .scroll { overflow: visible; }
  table { font-size: 8.5pt; }
  th, td { padding: .2rem .4rem; }
  a { color: inherit; text-decoration: none; }
}
)";

}  // namespace zlg::report
