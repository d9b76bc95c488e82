import { usePlc } from "../../../store/plc/plc";
import { BreakpointList } from "./BreakpointList";
import { CallStack } from "./CallStack";
import "./debug.css";
import { Variables } from "./Variables";

/** Below the explorer: where the program stands, what its variables are worth there, and the breakpoints. */
export function DebugSide() {
  const halt = usePlc((plc) => plc.state?.halt ?? null);
  return (
    <aside className="debugside" data-pane="debug" data-live>
      {halt && <CallStack halt={halt} />}
      {halt && <Variables />}
      <BreakpointList />
    </aside>
  );
}
