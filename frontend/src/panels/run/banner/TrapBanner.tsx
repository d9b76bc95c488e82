import { grouped } from "../../../logic/format/numbers";
import { recoverAndGoOn, restart } from "../../../store/debug/run";
import { openFile } from "../../../store/page/navigate";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { InstanceState } from "../../../wire/types";

/** A run-time error stopped the program: why, where, and how to continue. */
export function TrapBanner({ state }: { state: InstanceState }) {
  const { trap } = state;
  const message = trap?.message ?? state.message;
  return (
    <div className="banner fatal" role="alert">
      <Icon name="fatal" />
      <span className="grow">
        <b>
          {message.charAt(0).toUpperCase()}
          {message.slice(1)}
        </b>
        {trap && (
          <>
            {t("trap.at")}
            <button type="button" className="link mono" onClick={() => openFile(trap.file, trap.line, trap.column)}>
              {`${trap.file}:${trap.line}`}
            </button>
            {t("trap.scan", { scan: grouped(trap.scan) })}
          </>
        )}{" "}
        <span className="muted">{t("trap.about")}</span>
      </span>
      <button type="button" className="btn sm" title={t("trap.goon.hint")} onClick={() => void recoverAndGoOn()}>
        {t("trap.goon")}
      </button>
      <button type="button" className="btn danger sm" title={t("trap.cold.hint")} onClick={() => void restart("cold")}>
        {t("trap.cold")}
      </button>
    </div>
  );
}
