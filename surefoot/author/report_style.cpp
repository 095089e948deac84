#include <surefoot/author/report_style.h>

namespace surefoot {

const char* report_style() {
    // Okabe and Ito's colours, told apart with the common kinds of colour blindness.
    return R"css(
:root { color-scheme: light dark; --paper:#fbfbf9; --ink:#1d2126; --soft:#5d6670; --rule:#dcdfe2; --card:#ffffff;
  --mesh:#e9f0f6; --edge:#8ea3b5; --grid:#e6e9ec; --hatch:#cfd4d9; --sample:#0b5a8f; --halo:#ffffff;
  --error:#c2410c; --warning:#9a6700; --info:#2b6cb0; --needed:#e07b00; --suggested:#00825f; --close:#a23b8a; --acute:#f0c53a; }
@media (prefers-color-scheme: dark) { :root { --paper:#16191d; --ink:#e7eaee; --soft:#9aa5b1; --rule:#343a42; --card:#1d2126;
  --mesh:#24384a; --edge:#5f7d97; --grid:#2a3037; --hatch:#3d454e; --sample:#7cc4f5; --halo:#16191d;
  --error:#ff8a5c; --warning:#e3b341; --info:#79b8ff; --needed:#ffa033; --suggested:#3fd0a4; --close:#e58fd2; --acute:#d9ad28; } }
@media print { :root { color-scheme: light; --paper:#fff; --ink:#000; --soft:#444; --rule:#ccc; --card:#fff; --mesh:#e9f0f6;
  --edge:#8ea3b5; --grid:#e6e9ec; --hatch:#cfd4d9; --sample:#0b5a8f; --halo:#fff; --error:#c2410c; --warning:#8a5a00;
  --info:#2b6cb0; --needed:#e07b00; --suggested:#00825f; --close:#a23b8a; --acute:#f0c53a; }
  body { font-size: 9.5pt; } figure, tr, li { break-inside: avoid; } h2, h3 { break-after: avoid; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1040px; padding: 28px 24px 60px; background: var(--paper); color: var(--ink);
  font: 15px/1.5 system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", sans-serif; -webkit-print-color-adjust: exact; print-color-adjust: exact; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 4px; overflow-wrap: anywhere; }
h2 { font-size: 21px; margin: 44px 0 6px; padding-top: 14px; border-top: 2px solid var(--ink); }
h3 { font-size: 16px; margin: 24px 0 6px; }
p { margin: 6px 0 12px; max-width: 74ch; }
.lead { color: var(--soft); margin: 0 0 18px; }
.tiles { display: flex; flex-wrap: wrap; gap: 10px; margin: 18px 0; padding: 0; list-style: none; }
.tiles li { background: var(--card); border: 1px solid var(--rule); border-radius: 8px; padding: 8px 16px 10px; min-width: 108px; }
.tiles b { display: block; font-size: 24px; line-height: 1.15; font-variant-numeric: tabular-nums; }
.tiles span { color: var(--soft); font-size: 13px; }
figure { margin: 14px 0 8px; background: var(--card); border: 1px solid var(--rule); border-radius: 10px; padding: 12px 12px 10px; }
svg.space { display: block; width: 100%; height: auto; }
.legend { display: flex; flex-wrap: wrap; gap: 4px 20px; margin: 6px 10px 2px; padding: 0; list-style: none; font-size: 13px; color: var(--soft); }
.legend li { display: flex; align-items: center; gap: 7px; }
.legend svg { width: 30px; height: 22px; flex: none; }
.plot { fill: var(--card); stroke: var(--rule); } .grid { stroke: var(--grid); stroke-width: 1; }
.zero { stroke: var(--ink); stroke-width: 1.6; opacity: .75; } .zero.missing { stroke-dasharray: 3 5; opacity: .35; }
.hatch { stroke: var(--hatch); stroke-width: 1.6; } .dot { fill: var(--ink); opacity: .55; }
.triangle { fill: var(--mesh); stroke: var(--edge); stroke-width: 1.2; stroke-linejoin: round; }
.acute { fill: var(--acute); fill-opacity: .55; stroke: var(--warning); stroke-width: 1.6; stroke-linejoin: round; }
.crossing { stroke: var(--error); stroke-width: 2.6; } .cross { stroke: var(--error); stroke-width: 3; stroke-linecap: round; }
.opposite { stroke: var(--error); stroke-width: 11; stroke-opacity: .22; stroke-linecap: round; }
.dissimilar { stroke: var(--info); stroke-width: 2; stroke-dasharray: 9 4 2 4; }
.close { fill: var(--close); fill-opacity: .13; stroke: var(--close); stroke-width: 1.8; stroke-dasharray: 5 3; }
.misaligned { fill: none; stroke: var(--warning); stroke-width: 2.2; }
.sample { fill: var(--sample); stroke: var(--halo); stroke-width: 1.6; }
.number { fill: var(--halo); font-size: 9.5px; font-weight: 700; pointer-events: none; }
.needed { fill: var(--needed); stroke: var(--halo); stroke-width: 1.5; } .plus { stroke: #fff; stroke-width: 2.2; fill: none; }
.suggested { fill: none; stroke: var(--suggested); stroke-width: 2.6; stroke-linejoin: round; }
.name { font-size: 11.5px; fill: var(--ink); paint-order: stroke; stroke: var(--halo); stroke-width: 3.4px; stroke-linejoin: round; }
.leader { stroke: var(--soft); stroke-width: .9; } .tick { font-size: 11.5px; fill: var(--soft); }
.title { font-size: 13px; fill: var(--ink); } .title.absent { fill: var(--soft); font-style: italic; }
svg text { font-family: system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", sans-serif; }
ul.findings { list-style: none; padding: 0; margin: 8px 0; }
ul.findings > li { border-left: 4px solid var(--soft); padding: 3px 0 5px 14px; margin: 0 0 10px; }
li.error { border-color: var(--error) !important; } li.warning { border-color: var(--warning) !important; } li.info { border-color: var(--info) !important; }
.rule { font-weight: 650; } .chip { display: inline-block; font-size: 11.5px; font-weight: 700; letter-spacing: .03em; text-transform: uppercase; margin-right: 8px; }
.chip.error { color: var(--error); } .chip.warning { color: var(--warning); } .chip.info { color: var(--info); }
.fix { color: var(--soft); } .fix b { color: var(--ink); font-weight: 600; } .count { color: var(--soft); font-weight: 400; }
details { margin: 2px 0; } summary { cursor: pointer; } details ul { margin: 6px 0; padding-left: 20px; } details li { margin: 4px 0; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; width: 100%; font-size: 13px; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: 4px 8px; border-bottom: 1px solid var(--rule); white-space: nowrap; vertical-align: top; }
th { font-weight: 600; color: var(--soft); text-align: right; border-bottom: 1.5px solid var(--ink); }
th.t, td.t { text-align: left; } td.w { white-space: normal; text-align: left; min-width: 220px; overflow-wrap: anywhere; }
.wanted { list-style: none; padding: 0; margin: 8px 0; } .wanted li { display: flex; gap: 10px; align-items: center; padding: 3px 0; }
.wanted svg { width: 24px; height: 22px; flex: none; } code { font-size: .92em; } footer { color: var(--soft); font-size: 13px; margin-top: 44px; }
)css";
}

}  // namespace surefoot
