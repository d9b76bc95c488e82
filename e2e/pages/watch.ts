import { expect, type Locator, type Page } from '@playwright/test';

/** The watch table, which shows and changes values. */
export class Watch {
  constructor(private readonly page: Page) {}

  get table(): Locator {
    return this.page.getByRole('treegrid', { name: 'Watch table' });
  }

  row(path: string): Locator {
    return this.table.getByRole('row').and(this.page.locator(`[data-path="${path}"]`));
  }

  value(path: string): Locator {
    return this.page.getByTestId(`current:${path}`);
  }

  entry(path: string): Locator {
    return this.page.getByRole('textbox', { name: `Change ${path}`, exact: true });
  }

  /** Why the last entry was refused; shown below its row. */
  get refusal(): Locator {
    return this.table.getByRole('alert');
  }

  async shows(path: string, value: string | RegExp): Promise<void> {
    await expect(this.value(path)).toHaveText(value);
  }

  async number(path: string): Promise<number> {
    return Number(await this.value(path).textContent());
  }

  async add(path: string): Promise<void> {
    const box = this.page.getByRole('combobox', { name: 'Add to watch' });
    await box.fill(path);
    await box.press('Enter');
    await expect(this.row(path)).toBeVisible();
  }

  async write(path: string, value: string): Promise<void> {
    await this.entry(path).fill(value);
    await this.entry(path).press('Enter');
  }

  /** Writes, and waits until it was accepted: the entry is empty again. */
  async set(path: string, value: string): Promise<void> {
    await this.write(path, value);
    await expect(this.entry(path)).toHaveValue('');
  }

  async fromMenu(path: string, item: string, role: 'menuitem' | 'menuitemradio' = 'menuitem'): Promise<void> {
    await this.name(path).click({ button: 'right' });
    // Some names are followed by a key.
    await this.page
      .getByRole(role, { name: new RegExp(`^${item.replace(/[^\w ]/g, '\\$&')}( Space| (Shift\\+)?F7)?$`) })
      .click();
  }

  get pane(): Locator {
    return this.page.locator('[data-pane="watch"]');
  }

  /** Which list is shown, and whether it is shared. */
  get picker(): Locator {
    return this.page.getByRole('button', { name: /^Watch list / });
  }

  async list(item: string): Promise<void> {
    await this.picker.click();
    await this.page.getByRole('menuitem', { name: item, exact: true }).click();
  }

  /** Makes an empty list, and waits until it is shown: what is not saved of the one before is saved first. */
  async newList(): Promise<void> {
    await this.list('New list');
    await expect.poll(() => this.paths()).toEqual([]);
  }

  /** Shows a different list, such as `Belt 3`, which everybody shares, and waits until it has arrived. */
  async chooseShared(list: string): Promise<void> {
    await this.picker.click();
    await this.page.getByRole('menuitemradio', { name: `${list} shared`, exact: true }).click();
    await expect(this.picker).toHaveAccessibleName(`Watch list ${list}, shared`);
  }

  async renameList(name: string): Promise<void> {
    await this.list('Rename list');
    await this.page.getByRole('textbox', { name: 'Name of the list' }).fill(name);
    await this.page.keyboard.press('Enter');
    await expect(this.picker).toContainText(name);
  }

  /** The menu of groups and files. */
  async more(item: string): Promise<void> {
    await this.page.getByRole('button', { name: 'Groups, import, export' }).click();
    await this.page.getByRole('menuitem', { name: item, exact: true }).click();
  }

  async newGroup(name: string): Promise<void> {
    await this.more('New group…');
    await this.page.getByRole('textbox', { name: 'Name of the group' }).fill(name);
    await this.page.keyboard.press('Enter');
    await expect(this.group(name)).toBeVisible();
  }

  group(name: string): Locator {
    return this.table
      .getByRole('row')
      .filter({ has: this.page.getByRole('button', { name: new RegExp(`old ${name}$`) }) });
  }

  /** The handle by which a row is dragged. */
  name(path: string): Locator {
    return this.row(path).locator('.name');
  }

  async remove(path: string): Promise<void> {
    await this.name(path).click();
    await this.page.keyboard.press('Delete');
    await expect(this.row(path)).toBeHidden();
  }

  /** The paths of the rows, from top to bottom. */
  async paths(): Promise<string[]> {
    return this.table.locator('[data-path]').evaluateAll((rows) =>
      rows
        .map((row) => ({ path: (row as HTMLElement).dataset.path ?? '', at: row.getBoundingClientRect().top }))
        .sort((a, b) => a.at - b.at)
        .map(({ path }) => path),
    );
  }

  /** Pastes this text into the table, or into the box above it while the table is empty. */
  async paste(text: string): Promise<void> {
    const target = this.page.getByRole('combobox', { name: 'Add to watch' });
    await target.evaluate((element, pasted) => {
      const clipboardData = new DataTransfer();
      clipboardData.setData('text/plain', pasted);
      element.dispatchEvent(new ClipboardEvent('paste', { clipboardData, bubbles: true, cancelable: true }));
    }, text);
  }

  /** Drags a selection of the editor to the table, with the mouse. */
  async dragSelection(from: Locator): Promise<void> {
    const [start, end] = [await from.boundingBox(), await this.table.boundingBox()];
    if (!start || !end) throw new Error('nothing to drag, or nowhere to');
    await this.page.mouse.move(start.x + 30, start.y + 8);
    await this.page.mouse.down();
    await this.page.mouse.move(start.x + 60, start.y + 30);
    await this.page.mouse.move(end.x + 80, end.y + end.height - 20, { steps: 4 });
    await this.page.mouse.up();
  }

  /** The line below an in-out: how it is bound, and by which call. */
  binding(path: string): Locator {
    return this.row(path).locator('xpath=following-sibling::*[contains(@class, "binding")][1]');
  }

  async pickCall(path: string, actual: RegExp): Promise<void> {
    await this.page.getByRole('button', { name: `Other call for ${path}` }).click();
    await this.page.getByRole('menuitemradio', { name: actual }).click();
  }

  async importCsv(path: string): Promise<void> {
    await this.page.getByTestId('watch-csv').setInputFiles(path);
  }

  /** The lock at the left of a forced row. */
  releaseOf(path: string): Locator {
    return this.page.getByRole('button', { name: `Release force of ${path}`, exact: true });
  }

  /** The author of the last write, as the tooltip of the name says. */
  writtenBy(path: string, who: string): Locator {
    return this.row(path).getByTitle(`Written by ${who}`);
  }
}
