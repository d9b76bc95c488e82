import { usePlc } from "../../store/plc";
import { FatalBanner } from "./FatalBanner";
import { LostBanner } from "./LostBanner";
import { RestartingBanner } from "./RestartingBanner";
import { TrapBanner } from "./TrapBanner";

/** At most one banner, the most serious: no connection, then what stops the PLC. */
export function Banners() {
  const link = usePlc((plc) => plc.link);
  const state = usePlc((plc) => plc.state);
  if (link.state === "lost") return <LostBanner link={link} />;
  if (!state) return null;
  switch (state.state) {
    case "trapped":
      return <TrapBanner state={state} />;
    case "fatal":
      return <FatalBanner state={state} />;
    case "restarting":
    case "failed":
      return <RestartingBanner state={state} />;
    default:
      return null;
  }
}
