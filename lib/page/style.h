// How a page looks: on a screen, light or dark, on a phone, on paper.
#pragma once

#include <string_view>

namespace gainsmith::page {

/// A style sheet without "<" and "&", which XML would have to escape. --w is the width of a formula
/// in em, which shrinks it to its column; --yes, --no and --open colour verdicts.
inline constexpr std::string_view style = R"(
:root{color-scheme:light dark;--math:1.08rem;--text:#202020;--dim:#606060;--line:#d0d0d0;--back:#fff;--soft:#f4f4f2;--yes:#00664b;--no:#a03000;--open:#7a5c00;--link:#005a94}
@media(prefers-color-scheme:dark){:root{--text:#e4e4e0;--dim:#a0a09c;--line:#484846;--back:#181818;--soft:#242423;--yes:#4fc79b;--no:#ff9466;--open:#e0b84a;--link:#7cc0f0}}
*{box-sizing:border-box}
body{margin:0 auto;padding:1rem;max-width:62rem;font:16px/1.5 Helvetica,Arial,"Liberation Sans","DejaVu Sans",sans-serif;color:var(--text);background:var(--back);overflow-wrap:break-word}
h1{font-size:1.6rem;line-height:1.2;margin:.5rem 0}h2{font-size:1.3rem;margin:1rem 0 .5rem}
h3{font-size:1.1rem;margin:1.6rem 0 .4rem;border-bottom:1px solid var(--line)}
h4{font-size:.95rem;margin:1rem 0 .2rem;color:var(--dim)}
p{margin:.4rem 0;max-width:46rem}a{color:var(--link)}
.remark,.name,figcaption,footer{color:var(--dim);font-size:.9rem}
.verdict{font-weight:bold;font-size:1.15rem;white-space:pre-wrap}.yes{color:var(--yes)}.no,.warning{color:var(--no)}.undecided{color:var(--open)}
.row{container-type:inline-size;display:flex;flex-wrap:wrap;align-items:center;gap:.1rem 1rem;padding:.15rem 0 .15rem .8rem;border-left:2px solid var(--line)}
.row>*{max-width:100%}.row .name{min-width:4rem;overflow-wrap:anywhere}.row .remark{overflow-wrap:anywhere}
.wide{padding-left:1.2rem;text-indent:-1.2rem}.part .part{--in:2.4rem;display:inline-block;max-width:100%;padding-left:1.2rem;text-indent:-1.2rem}.part .part .part{padding:0;text-indent:0}
math{font-size:min(var(--math),calc((100cqw - var(--in,1.2rem))/var(--w,1)));text-indent:0;white-space:pre;font-family:"STIX Two Math","Latin Modern Math","Cambria Math","Libertinus Math","DejaVu Math TeX Gyre",math}.wide math{math-style:normal;margin:.2rem 0}
mtable{width:max-content}mtable.m{margin:.1em .15em;border:solid;border-width:0 1.5px;background:linear-gradient(currentColor,currentColor) 0 0/.3em 1.5px,linear-gradient(currentColor,currentColor) 0 100%/.3em 1.5px,linear-gradient(currentColor,currentColor) 100% 0/.3em 1.5px,linear-gradient(currentColor,currentColor) 100% 100%/.3em 1.5px;background-repeat:no-repeat;print-color-adjust:exact;-webkit-print-color-adjust:exact}
mtable.c{border:solid;border-width:0 0 0 1.5px;border-radius:.5em;padding-left:.2em}
mtd{padding:.15em .4em}mtd.l{text-align:left}
table{border-collapse:collapse;font-size:.92rem;margin:.4rem 0}
td,th{padding:.2rem .7rem .2rem 0;text-align:left;vertical-align:top;border-bottom:1px solid var(--line);font-variant-numeric:tabular-nums}
th{color:var(--dim);font-weight:normal}.bad td{color:var(--no)}
td code{overflow-wrap:anywhere}
code,pre{font-family:"DejaVu Sans Mono",Consolas,monospace;font-size:.85rem}
pre{background:var(--soft);padding:.6rem;white-space:pre-wrap;overflow-wrap:anywhere}
summary{cursor:pointer;padding:.2rem 0}article+article,details.problem{border-top:1px solid var(--line)}
details.problem{padding:.2rem 0}details.problem>summary{font-weight:bold}
figure{margin:1rem 0}.picture{background:#fff;border-radius:4px}.picture svg{display:block;width:100%;height:auto}
@media(max-width:40rem){body{padding:.6rem;font-size:15px}.row{gap:0 .6rem}
thead{display:none}tr{display:block;padding:.2rem 0;border-bottom:1px solid var(--line)}td,th{display:inline-block;padding:0 1rem 0 0;border:0}td:empty{display:none}td[data-head]:not([colspan])::before{content:attr(data-head) " ";color:var(--dim)}}
@media print{:root{color-scheme:light;--math:10pt;--text:#000;--dim:#404040;--line:#b0b0b0;--back:#fff;--soft:#f4f4f4;--yes:#00543d;--no:#8a2900;--open:#604800;--link:#000}
body{max-width:none;padding:0;font-size:10pt}.picture svg{max-height:23cm}h3,h4{break-after:avoid}.row,tr,figure{break-inside:avoid}details:not([open]){display:none}a{text-decoration:none}}
)";

}  // namespace gainsmith::page
