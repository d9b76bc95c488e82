import { t } from "../../../text";
import { Empty } from "../../../ui/Empty";

/** No sweep yet: what a sweep is for, and how to begin one. */
export function NoSweeps() {
  return (
    <Empty
      title={t("sweep.empty.title")}
      about={t("sweep.empty.about")}
      ways={[
        { icon: "plus", strong: t("sweep.empty.keep"), rest: t("sweep.empty.keep.rest") },
        { icon: "generated", strong: t("sweep.empty.run"), rest: t("sweep.empty.run.rest") },
        { icon: "unhandled", strong: t("sweep.empty.find"), rest: t("sweep.empty.find.rest") },
      ]}
    />
  );
}
