// The page: which part is shown, what the address says, and the parts.
import { element } from "./dom";
import { Engine } from "./engine";
import { dataPart } from "./data";
import type { Page, Shown } from "./part";
import { rigPart } from "./rig";
import { runPart } from "./run";
import { parts, read, write, type Part, type State } from "./state";
import { studyParts } from "./study";
import { verdictsPart } from "./verdicts";

const titles: Record<Part, string> = {
  study: "Your study", knobs: "Turn the knobs", run: "One run", rig: "The rig", data: "Your own data", verdicts: "Verdicts",
};
const sections: Record<Part, string[]> = {
  study: ["part-study", "bench", "study-results", "download"], knobs: ["part-knobs", "bench", "knob-results", "download"],
  run: ["part-run"], rig: ["part-rig"], data: ["part-data"], verdicts: ["part-verdicts"],
};

function failed(message: string): void {
  const box = element("failure");
  box.textContent = "The library did not start in this browser: " + message +
    ". It needs WebAssembly with SIMD and exceptions, which Chrome, Firefox and Safari have had since 2022.";
  box.hidden = false;
}

const page: Page = {
  state: read(location.hash),
  engine: new Engine(failed),
  change(settings, replace = false) {
    const next = { ...page.state, ...settings };
    if (write(next) === write(page.state)) return;
    history[replace ? "replaceState" : "pushState"](null, "", write(next));
    update(next);
  },
  address: (settings) => write({ ...page.state, ...settings }),
};

const study = studyParts(page);
const shown: Record<Part, Shown> = {
  study, knobs: study, run: runPart(page), rig: rigPart(page), data: dataPart(page), verdicts: verdictsPart(page),
};

function update(next: State, first = false): void {
  const before = page.state.part;
  page.state = next;
  if (before !== next.part || first) {
    const all = new Set(Object.values(sections).flat());
    for (const id of all) element(id).hidden = !sections[next.part].includes(id);
    if (shown[before] !== shown[next.part]) shown[before].hide?.();
    document.body.dataset.part = next.part;
    document.title = titles[next.part] + " – the paper, live";
  }
  document.querySelectorAll<HTMLAnchorElement>("#nav a").forEach((a) => {
    const part = a.dataset.part as Part;
    a.href = page.address({ part });
    if (part === next.part) a.setAttribute("aria-current", "page"); else a.removeAttribute("aria-current");
  });
  const place = parts.indexOf(next.part);
  for (const [id, part, arrow] of [["previous", parts[place - 1], "← "], ["next", parts[place + 1], " →"]] as const) {
    const link = element<HTMLAnchorElement>(id);
    link.hidden = part === undefined;
    if (part) {
      link.href = page.address({ part });
      link.textContent = id === "next" ? titles[part] + arrow : arrow + titles[part];
    }
  }
  shown[next.part].show(next);
  if (before !== next.part && !first) {
    scrollTo(0, 0);
    element("h-" + next.part).focus({ preventScroll: true });
  }
}

addEventListener("popstate", () => update(read(location.hash)));
element("skip").addEventListener("click", (event) => {
  event.preventDefault();
  element("main").focus();
});
document.body.dataset.ready = "yes";
update(page.state, true);
