import { t } from "../../text";
import { Empty } from "../../ui/Empty";
import { AddSignal } from "./AddSignal";

/** No trace yet: what a trace is, and how to begin one. */
export function EmptyTrace() {
  return (
    <div className="trempty">
      <Empty
        title={t("trace.empty.title")}
        about={t("trace.empty.about")}
        ways={[
          { icon: "keyboard", strong: t("trace.empty.type"), rest: t("trace.empty.type.rest") },
          { icon: "mouse", strong: t("trace.empty.drag"), rest: t("trace.empty.drag.rest") },
          { icon: "past", strong: t("trace.empty.past"), rest: t("trace.empty.past.rest") },
        ]}
      >
        <AddSignal />
      </Empty>
    </div>
  );
}
