// How a page looks: on a screen, light or dark, on a phone, on paper.
#pragma once

#include <string_view>

namespace gainsmith::page {

/// A style sheet without "<" and "&".
inline constexpr std::string_view style = R"(
:root{color-scheme:light dark;--text:#202020;--dim:#606060;--line:#d0d0d0;--back:#fff;--soft:#f4f4f2;--yes:#00664b;--no:#a03000;--open:#7a5c00;--link:#005a94}
@media(prefers-color-scheme:dark){:root{--text:#e4e4e0;--dim:#a0a09c;--line:#484846;--back:#181818;--soft:#242423;--yes:#4fc79b;--no:#ff9466;--open:#e0b84a;--link:#7cc0f0}}
*{box-sizing:border-box}
body{margin:0 auto;padding:1rem;max-width:62rem;font:16px/1.5 Helvetica,Arial,"Liberation Sans","DejaVu Sans",sans-serif;color:var(--text);background:var(--back);overflow-wrap:break-word}
h1{font-size:1.6rem;line-height:1.2;margin:.5rem 0}h2{font-size:1.3rem;margin:1rem 0 .5rem}
h3{font-size:1.1rem;margin:1.6rem 0 .4rem;border-bottom:1px solid var(--line)}
h4{font-size:.95rem;margin:1rem 0 .2rem;color:var(--dim)}
p{margin:.4rem 0;max-width:46rem}a{color:var(--link)}
.remark,.name,figcaption,footer{color:var(--dim);font-size:.9rem}
.verdict{font-weight:bold;font-size:1.15rem;white-space:pre-wrap}.yes{color:var(--yes)}.no,.warning{color:var(--no)}.undecided{color:var(--open)}
.wide{overflow-x:auto;max-width:100%}
.row{display:flex;flex-wrap:wrap;align-items:center;gap:.1rem 1rem;padding:.15rem 0 .15rem .8rem;border-left:2px solid var(--line)}
.row .name{min-width:4rem}
math{font-size:1.08rem;font-family:"STIX Two Math","Latin Modern Math","Cambria Math","Libertinus Math","DejaVu Math TeX Gyre",math}.wide>math{display:block math;math-style:normal;margin:.2rem 0;text-align:left;width:max-content}
mtable.m{margin:.1em .15em;border:solid;border-width:0 1.5px;background:linear-gradient(currentColor,currentColor) 0 0/.3em 1.5px,linear-gradient(currentColor,currentColor) 0 100%/.3em 1.5px,linear-gradient(currentColor,currentColor) 100% 0/.3em 1.5px,linear-gradient(currentColor,currentColor) 100% 100%/.3em 1.5px;background-repeat:no-repeat;print-color-adjust:exact;-webkit-print-color-adjust:exact}
mtable.c{border:solid;border-width:0 0 0 1.5px;border-radius:.5em;padding-left:.2em}
mtd{padding:.15em .4em}mtd.l{text-align:left}
table{border-collapse:collapse;font-size:.92rem;margin:.4rem 0}
td,th{padding:.2rem .7rem .2rem 0;text-align:left;vertical-align:top;border-bottom:1px solid var(--line);font-variant-numeric:tabular-nums}
th{color:var(--dim);font-weight:normal}.bad td{color:var(--no)}
.wide td{white-space:nowrap}.wide td[colspan],td code{white-space:normal;overflow-wrap:anywhere}
code,pre{font-family:"DejaVu Sans Mono",Consolas,monospace;font-size:.85rem}
pre{background:var(--soft);padding:.6rem;overflow-x:auto;white-space:pre-wrap}
summary{cursor:pointer;padding:.2rem 0}article+article,details.problem{border-top:1px solid var(--line)}
details.problem{padding:.2rem 0}details.problem>summary{font-weight:bold}
figure{margin:1rem 0}.picture{background:#fff;border-radius:4px}.picture svg{display:block;width:100%;height:auto}
@media(max-width:40rem){body{padding:.6rem;font-size:15px}.row{gap:0 .6rem}}
@media print{:root{color-scheme:light;--text:#000;--dim:#404040;--line:#b0b0b0;--back:#fff;--soft:#f4f4f4;--yes:#00543d;--no:#8a2900;--open:#604800;--link:#000}
body{max-width:none;padding:0;font-size:10pt}.wide,pre{overflow:visible}math{font-size:10pt}h3,h4{break-after:avoid}.row,tr,figure{break-inside:avoid}details:not([open]){display:none}a{text-decoration:none}}
)";

}  // namespace gainsmith::page
