import { useEffect } from "react";
import { showState } from "../logic/plc/plcstate";
import { useOnline, usePlc } from "../store/plc/plc";

/** What each window says of itself: its title, by what it shows, and its frame, which has the colour of the PLC's state. */
export function useFrame(...names: readonly (string | undefined)[]) {
  const online = useOnline();
  const connecting = usePlc((plc) => plc.link.state === "none" || plc.link.state === "connecting");
  const state = usePlc((plc) => plc.state);
  const shown = showState(state, online);
  const title = [...names, "Scanbench"].filter(Boolean).join(" – ");
  useEffect(() => {
    document.title = title;
  }, [title]);
  const frame = { "data-tone": connecting ? "none" : shown.tone, "data-link": online || connecting ? "open" : "lost" };
  return { frame, shown: state ? shown : null };
}
