import type { CSSProperties } from "react";
import type { Track } from "../../../logic/verify/verifyColumns";

/** The column of a cell in its row: cells outside the visible part are not drawn, so each states its column. */
export function placeOf(track: Track, tracks: readonly Track[], span = 1): CSSProperties {
  const at = tracks.indexOf(track) + 1;
  return {
    gridColumn: span === 1 ? at : `${at} / span ${span}`,
    gridRow: 1,
    ...(track.sticky ? { left: track.left } : {}),
  };
}
