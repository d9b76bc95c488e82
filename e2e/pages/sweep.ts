import { expect, type Locator, type Page } from '@playwright/test';

export interface Wanted {
  errors?: 'All errors of the model' | 'Non-fatal only' | 'Selected in the error simulator';
  /** Kept states to begin from; without any, the current state of the PLC. */
  states?: string[];
  scans?: number;
}

/** Error sweeps: their page in the centre, the dialog that begins one, and the kept states. */
export class Sweeps {
  constructor(private readonly page: Page) {}

  get pane(): Locator {
    return this.page.locator('[data-pane=sweep]');
  }

  get tab(): Locator {
    return this.page.getByRole('tab', { name: /^(Error sweep|Sweeps compared)/ });
  }

  get matrix(): Locator {
    return this.page.getByRole('grid', { name: 'Errors by program state' });
  }

  get details(): Locator {
    return this.page.getByRole('region', { name: 'Result' });
  }

  get progress(): Locator {
    return this.page.getByRole('progressbar', { name: 'Progress of the sweep' });
  }

  get counts(): Locator {
    return this.page.getByRole('toolbar', { name: 'Results, as a filter' });
  }

  /** The link to the printable record. */
  get record(): Locator {
    return this.pane.getByRole('link', { name: 'Test record' });
  }

  get list(): Locator {
    return this.page.getByRole('table', { name: 'Error sweeps' });
  }

  get states(): Locator {
    return this.page.getByRole('table', { name: 'Kept states' });
  }

  get changes(): Locator {
    return this.page.getByRole('table', { name: 'Changes from one sweep to the other' });
  }

  row(error: string): Locator {
    return this.matrix.getByRole('row').filter({ has: this.page.getByRole('rowheader', { name: error, exact: true }) });
  }

  /** A result by the name of its state, as in the column head. */
  async cell(error: string, state: string): Promise<Locator> {
    const head = this.matrix.getByRole('columnheader');
    await expect(head.filter({ hasText: state })).toBeVisible();
    const heads = await head.allTextContents();
    return this.row(error)
      .getByRole('gridcell')
      .nth(heads.indexOf(state) - 1);
  }

  async choose(error: string, state: string): Promise<void> {
    await (await this.cell(error, state)).click();
    await expect(this.details).toContainText(error);
  }

  private async fromMenu(item: string): Promise<void> {
    await this.page.getByRole('button', { name: 'Error simulator: actions' }).click();
    await this.page.getByRole('menuitem', { name: item, exact: true }).click();
  }

  /** Keeps the shown state of the PLC. */
  async keepState(name: string): Promise<void> {
    await this.fromMenu('Keep this state…');
    await this.nameState(name);
  }

  async nameState(name: string): Promise<void> {
    const dialog = this.page.getByRole('dialog', { name: /^Keep / });
    await dialog.getByRole('textbox', { name: 'Name of the state' }).fill(name);
    await dialog.getByRole('button', { name: 'Keep', exact: true }).click();
    await expect(dialog).toBeHidden();
  }

  get dialog(): Locator {
    return this.page.getByRole('dialog', { name: 'Run all' });
  }

  /** Opens the dialog, and fills it in. */
  async ask({ errors = 'All errors of the model', states, scans }: Wanted): Promise<void> {
    const button = this.pane.getByRole('button', { name: 'Run all…' });
    if (await button.isVisible()) await button.click();
    else await this.fromMenu('Run all…');
    await this.dialog.getByRole('radio', { name: new RegExp(`^${errors}`) }).check();
    if (states) {
      await this.dialog.getByRole('radio', { name: /^Kept states/ }).check();
      for (const box of await this.dialog.getByRole('checkbox').all()) {
        const name = (await box.getAttribute('aria-label')) ?? '';
        await box.setChecked(states.includes(name));
      }
    } else {
      await this.dialog.getByRole('radio', { name: /as it is now/ }).check();
    }
    if (scans !== undefined) await this.dialog.getByRole('textbox', { name: /^Reaction window/ }).fill(String(scans));
  }

  /** Begins a sweep; its page opens by itself. */
  async run(wanted: Wanted): Promise<void> {
    await this.ask(wanted);
    await this.dialog.getByRole('button', { name: /^Run \d/ }).click();
    await expect(this.dialog).toBeHidden();
    await expect(this.matrix).toBeVisible();
  }

  async finishes(): Promise<void> {
    await expect(this.pane.getByText('Done', { exact: true })).toBeVisible({ timeout: 120_000 });
  }

  async press(button: string): Promise<void> {
    await this.pane.getByRole('button', { name: button, exact: true }).click();
  }

  async showList(): Promise<void> {
    const back = this.pane.getByRole('button', { name: 'All sweeps and states' });
    if (await back.isVisible()) await back.click();
    else await this.fromMenu('Error sweeps');
    await expect(this.pane.getByRole('heading', { name: 'Error sweeps' })).toBeVisible();
  }

  /** Opens a sweep of the list, the newest first. */
  async open(index: number): Promise<void> {
    await this.list.locator('[data-sweep]').nth(index).getByRole('button').first().click();
    await expect(this.matrix).toBeVisible();
  }

  /** Compares the shown sweep with one of the menu, the newest first. */
  async compareWith(index: number): Promise<void> {
    await this.press('Compare');
    await this.page.getByRole('menuitem').nth(index).click();
    await expect(this.pane.getByRole('switch', { name: 'Only changes' })).toBeVisible();
  }

  change(error: string, state: string): Locator {
    return this.changes.getByRole('row').filter({ hasText: error }).filter({ hasText: state });
  }

  /** Gives the other panels their room back. */
  async narrow(): Promise<void> {
    await this.page.getByRole('button', { name: 'Restore the other panels' }).click();
  }
}
