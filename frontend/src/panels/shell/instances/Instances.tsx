import { useEffect, useMemo, useState } from "react";
import { bytes, percent } from "../../../logic/format/numbers";
import { type Order, shownInstances, sumOf } from "../../../logic/plc/instances";
import { useBench } from "../../../store/plc/bench";
import { openInstance, pollInstances, selectInstance, showInstances, useInstances } from "../../../store/plc/instances";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import { Icon } from "../../../ui/Icon";
import { Menu } from "../../../ui/Menu";
import type { Instance } from "../../../wire/types";
import { Actions } from "./Actions";
import { Asking, type Question } from "./Asking";
import { deeds } from "./deeds";
import { InstanceGrid } from "./InstanceGrid";
import "./instances.css";

/** Every virtual PLC of this server: its state, its load, and its actions. */
export function Instances() {
  const open = useInstances((instances) => instances.open);
  return open && <List />;
}

function List() {
  const { all, selected, trouble, damaged, transfer } = useInstances();
  const project = useBench((bench) => bench.project);
  const [filter, setFilter] = useState("");
  const [order, setOrder] = useState<Order>({ by: "name", down: false });
  const [question, setQuestion] = useState<Question | null>(null);
  const [menu, setMenu] = useState<{ of: Instance; at: { x: number; y: number } } | null>(null);
  const rows = useMemo(() => shownInstances(all, filter, order), [all, filter, order]);
  const instance = all.find(({ id }) => id === selected) ?? null;
  const sum = sumOf(all);
  useEffect(() => pollInstances(), []);

  return (
    <>
      <Dialog
        title={t("instances.list")}
        width={1240}
        onClose={() => showInstances(false)}
        footer={<Actions instance={instance} onAsk={setQuestion} />}
      >
        <div className="instances" style={{ "--rows": all.length }}>
          <div className="row">
            <span className="inp sm filter">
              <Icon name="search" small />
              <input
                type="search"
                aria-label={t("instances.filter")}
                placeholder={t("instances.filter")}
                value={filter}
                spellCheck={false}
                onChange={(event) => setFilter(event.target.value)}
              />
            </span>
            <span className="hint cut">
              {t("instances.count", { running: sum.running, count: all.length })}
              {" · "}
              {t("instances.count.load", { cpu: percent(sum.cpu), memory: bytes(sum.memory) })}
            </span>
            <span className="grow" />
            <button
              type="button"
              className="btn quiet sm"
              disabled={transfer !== null}
              onClick={() => setQuestion({ ask: "import" })}
            >
              <Icon name="import" small />
              {t("instances.import")}
            </button>
            <button
              type="button"
              className="btn sm"
              disabled={project === null}
              onClick={() => project && setQuestion({ ask: "new", project })}
            >
              <Icon name="plus" small />
              {t("instances.new")}
            </button>
          </div>
          {rows.length > 0 ? (
            <InstanceGrid
              rows={rows}
              order={order}
              selected={selected}
              onOrder={setOrder}
              onSelect={selectInstance}
              onOpen={openInstance}
              onMenu={(of, at) => setMenu({ of, at })}
              onDelete={(doomed) => setQuestion({ ask: "delete", instance: doomed })}
            />
          ) : (
            <p className="lonely faint">{t(all.length === 0 ? "instances.none" : "instances.nomatch")}</p>
          )}
          {damaged && (
            <p className="trouble st warning" role="status">
              <Icon name="warning" small />
              <span>
                <b>{t("instances.import.found", damaged)}</b> {damaged.damage}
              </span>
            </p>
          )}
          {trouble && (
            <p className="trouble st fatal" role="alert">
              <Icon name="error" small />
              <span>{trouble}</span>
            </p>
          )}
        </div>
      </Dialog>
      {menu && (
        <Menu label={menu.of.name} items={deeds(menu.of, setQuestion)} at={menu.at} onClose={() => setMenu(null)} />
      )}
      {question && <Asking question={question} onClose={() => setQuestion(null)} />}
    </>
  );
}
