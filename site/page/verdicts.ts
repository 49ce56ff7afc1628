// Part 6: the verdicts, each with the view that shows it.
import { element, escape, rowsOf } from "./dom";
import type { Page, Shown } from "./part";
import type { State } from "./state";

declare const VERDICTS: string;

/** The view of this page, or the figure, behind a claim. */
const shownBy: Record<string, { view?: Partial<State>; label: string; figure?: string }> = {
  C1: { view: { part: "study" }, label: "the p-boxes, live" },
  C2: { view: { part: "study" }, label: "the two areas, live", figure: "fig9_null_distributions.png" },
  C3: { view: { part: "study" }, label: "the p-box of the frequency, live", figure: "fig9_null_distributions.png" },
  C4: { view: { part: "study" }, label: "the iterations, live", figure: "fig10_iteration_tables.png" },
  C5: { view: { part: "knobs", ess: "0.9" }, label: "turn the criterion", figure: "fig12_cost_accuracy.png" },
  C6: { view: { part: "study" }, label: "Table 4, live" },
  C7: { view: { part: "rig", friction: "1.086" }, label: "the curve at 1.086 N", figure: "fig2_phase_angle.png" },
  C8: { view: { part: "knobs" }, label: "the slider of both rules" },
  C9: { view: { part: "run" }, label: "beta, stage by stage", figure: "fig5_tempering.png" },
  C10: { view: { part: "study" }, label: "the iterations, live", figure: "fig10_iteration_tables.png" },
  C11: { view: { part: "knobs" }, label: "stages against area" },
  C12: { view: { part: "knobs", moves: "recommended" }, label: "better moves, live", figure: "fig7_pbox_floor.png" },
  C13: { label: "" },
  C14: { label: "" },
  C15: { view: { part: "data" }, label: "the noise levels, live", figure: "fig15_prior_sensitivity.png" },
};

export function verdictsPart(page: Page): Shown {
  return {
    show() {
      element("verdict-list").innerHTML = rowsOf(VERDICTS).map((row) => {
        const by = shownBy[row.id!];
        const links = [
          by?.view ? `<a href="${page.address(by.view)}">See ${by.label}</a>` : "",
          by?.figure ? `<a href="../../figures/${by.figure}">Figure ${/\d+/.exec(by.figure)![0]}</a>` : "",
        ].filter(Boolean).join(" · ");
        return `<article class="verdict"><b>${row.id}</b><div><h3>${escape(row.claim!)}</h3><p>${escape(row.evidence!)}</p><p>${links}</p></div>
          <p class="says">${escape(row.verdict!)}<small>number: ${escape(row.number!)}</small><small>${escape(row.place!)}</small></p></article>`;
      }).join("");
    },
  };
}
