import { usePlc } from "../../../store/plc/plc";
import { BreakpointList } from "./BreakpointList";
import { CallStack } from "./CallStack";
import "./debug.css";
import { Variables } from "./Variables";

/** Below the explorer: the call stack, the variables of the selected frame, and the breakpoints. */
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
