// A part of the page, and what the page offers to it.
import type { Engine } from "./engine";
import type { State } from "./state";

/** What a part gets: the state, and how it changes it. */
export interface Page {
  state: State;
  engine: Engine;
  /** Changes settings. A new entry of the history unless `replace`. */
  change(settings: Partial<State>, replace?: boolean): void;
  address(settings: Partial<State>): string;
}

/** A part of the page; show() is called when it comes into view and when a setting has changed. */
export interface Shown {
  show(state: State): void;
  hide?(): void;
}
