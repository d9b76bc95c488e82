/** When the next fault begins and how it continues, as typed; checked against the scan that the PLC has reached. */
import { useSyncExternalStore } from "react";
import { isPlain, readShape, type ShapeForm } from "../../logic/errors/shapes";
import { bindClock, readClock } from "../plc/clock";
import { useSimulator } from "./simulator";

interface ReadForm {
  form: ShapeForm;
  /** An ordinary Generate. */
  plain: boolean;
  troubles: ReturnType<typeof readShape>["troubles"];
  ready: boolean;
}

/** A future scan becomes a past one some time: the message then appears without a key press. */
export function useShape(): ReadForm {
  const form = useSimulator((state) => state.shape);
  const troubled = () => JSON.stringify(readShape(form, readClock().scan).troubles);
  const troubles: ReadForm["troubles"] = JSON.parse(useSyncExternalStore(bindClock, troubled));
  return { form, plain: isPlain(form), troubles, ready: Object.keys(troubles).length === 0 };
}
