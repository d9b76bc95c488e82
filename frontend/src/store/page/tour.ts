/** The tour of the sample: whether it is open, and how far somebody came. Kept in this browser. */
import { create } from "zustand";
import { keep, recall } from "./localStorage";

interface Tour {
  open: boolean;
  /** The step that is next; it stays while the tour is closed. */
  at: number;
}

const kept = recall<Partial<Tour>>("tour", {});

export const useTour = create<Tour>(() => ({
  open: kept.open === true,
  at: Number.isInteger(kept.at) ? Math.max(0, kept.at ?? 0) : 0,
}));
useTour.subscribe((tour) => keep("tour", tour));

/** Goes on where somebody left it. */
export const openTour = () => useTour.setState({ open: true });

/** Leaves it; the step is kept. */
export const leaveTour = () => useTour.setState({ open: false });

export const goToStep = (at: number) => useTour.setState({ at });

/** It was seen to its end: the next time it begins at the first step. */
export const endTour = () => useTour.setState({ open: false, at: 0 });
