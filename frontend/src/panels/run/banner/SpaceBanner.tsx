import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { InstanceState } from "../../../wire/types";

/** The disk is full, so the PLC cannot begin: it has no process, and the server tries again and again. */
export function SpaceBanner({ state }: { state: InstanceState }) {
  return (
    <div className="banner fatal" role="alert">
      <Icon name="error" />
      <span className="grow">
        <b>{t("no_space.title")}</b> {state.message}
      </span>
    </div>
  );
}
