import { useEffect } from "react";
import { chooseInstance, chooseProject, refreshApp, useBench } from "../../../store/plc/bench";
import { showInstances } from "../../../store/plc/instances";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** Somebody deleted this PLC: what is shown is the last of it. The way on is a different one, of the same project first. */
export function DeletedBanner({ by }: { by: string }) {
  const { app, instance, project } = useBench();
  useEffect(() => {
    refreshApp().catch(() => undefined); // the list that is known already is offered
  }, []);
  if (!instance) return null;
  const others = (app?.instances ?? []).filter(({ id }) => id !== instance.id);
  const next = others.find((other) => other.project.id === project?.id) ?? others[0];
  return (
    <div className="banner stale" role="alert">
      <Icon name="trash" />
      <span className="grow">
        <b>{t("gone.title", { name: instance.name, by })}</b> <span className="muted">{t("gone.about")}</span>
      </span>
      {others.length > 1 && (
        <button type="button" className="btn sm" onClick={() => showInstances(true)}>
          {t("gone.choose")}
        </button>
      )}
      <button
        type="button"
        className="btn primary sm"
        onClick={() => void (next ? chooseInstance(next) : chooseProject(instance.project))}
      >
        {next
          ? t("gone.open", { name: `${next.project.name} / ${next.name}` })
          : t("gone.project", { name: instance.project.name })}
      </button>
    </div>
  );
}
