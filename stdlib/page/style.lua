--- The style sheet of report pages.
return [==[
:root { color-scheme: light; --ink: #1d2733; --soft: #5d6b7a; --line: #dfe4ea; --accent: #1f6feb; }
* { box-sizing: border-box; }
body { margin: 0; font: 15px/1.45 system-ui, "DejaVu Sans", sans-serif; color: var(--ink); background: #f5f7f9; }
header { padding: 14px 24px 10px; background: #fff; border-bottom: 1px solid var(--line); }
h1 { font-size: 20px; margin: 0; overflow-wrap: anywhere; }
header p { margin: 2px 0 0; color: var(--soft); overflow-wrap: anywhere; }
main { display: grid; grid-template-columns: minmax(340px, 0.8fr) minmax(560px, 1fr); gap: 18px; padding: 18px 24px; align-items: start; }
@media (max-width: 1000px) { main { grid-template-columns: 1fr; } #side { position: static !important; } }
#side { position: sticky; top: 18px; }
#view { position: relative; height: min(66vh, 640px); background: linear-gradient(#fdfefe, #dfe6ec); border: 1px solid var(--line);
  border-radius: 8px; overflow: hidden; touch-action: none; cursor: grab; }
#view canvas { display: block; }
#view .note { position: absolute; left: 12px; bottom: 8px; color: var(--soft); font-size: 12.5px; pointer-events: none; }
#view .shown { position: absolute; left: 12px; top: 8px; font-weight: 600; pointer-events: none; }
.controls { display: flex; flex-wrap: wrap; gap: 4px 18px; padding: 6px 2px 0; font-size: 13.5px; color: var(--soft); }
.controls button { font: inherit; color: inherit; border: 1px solid var(--line); border-radius: 5px; background: #fff; cursor: pointer; }
.key { display: inline-block; width: 11px; height: 11px; border-radius: 3px; margin-right: 5px; }
.card { background: #fff; border: 1px solid var(--line); border-radius: 8px; max-height: calc(100vh - 120px); overflow: auto; }
.card::-webkit-scrollbar { width: 12px; height: 12px; }
.card::-webkit-scrollbar-track { background: #eef1f4; }
.card::-webkit-scrollbar-thumb { background: #a9b4c2; border: 2px solid #eef1f4; border-radius: 6px; }
table { border-collapse: collapse; width: 100%; }
th { position: sticky; top: 0; z-index: 1; background: #fff; text-align: right; font-size: 12.5px; font-weight: 600; color: var(--soft);
  padding: 9px 10px; border-bottom: 1px solid var(--line); vertical-align: bottom; white-space: nowrap; }
th button { all: unset; cursor: pointer; }
th button:focus-visible { outline: 2px solid var(--accent); }
th small { font-weight: 400; display: block; }
th[aria-sort] { color: var(--accent); }
th[aria-sort=descending] button::after { content: " \25BE"; }
th[aria-sort=ascending] button::after { content: " \25B4"; }
td { text-align: right; padding: 4px 10px; border-bottom: 1px solid #eef1f4; font-variant-numeric: tabular-nums; }
td.picture, th.picture { text-align: left; width: 112px; padding: 4px 6px 4px 10px; }
td img { display: block; width: 96px; height: 72px; border-radius: 4px; }
@media (max-width: 1500px) {
  th, td { padding-left: 6px; padding-right: 6px; }
  td { font-size: 14px; }
  td.picture, th.picture { width: 92px; }
  td img { width: 80px; height: 60px; }
}
tbody tr { cursor: pointer; }
tbody tr:hover { background: #f2f6fb; }
tbody tr[aria-selected=true] { background: #e4effd; box-shadow: inset 3px 0 var(--accent); }
section.words { padding: 0 24px 24px; }
section.words h2 { font-size: 15px; margin: 6px 0; }
pre { margin: 0; white-space: pre-wrap; overflow-wrap: anywhere; font: 13px/1.5 "DejaVu Sans Mono", monospace; color: var(--soft); }
ul { margin: 0 0 14px; padding-left: 20px; font-size: 13.5px; color: var(--soft); }
dl { margin: 0 0 14px; display: grid; grid-template-columns: max-content 1fr; gap: 2px 14px; font-size: 13.5px; }
dt { font-weight: 600; } dd { margin: 0; color: var(--soft); }
]==]
