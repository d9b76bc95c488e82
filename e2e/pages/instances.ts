import { expect, type Locator, type Page } from '@playwright/test';

/** The list of every instance: its state, its load, and its actions. */
export class InstanceList {
  constructor(private readonly page: Page) {}

  get dialog(): Locator {
    return this.page.getByRole('dialog', { name: 'Instances', exact: true });
  }

  row(name: string): Locator {
    return this.dialog.getByRole('row').and(this.page.locator(`[data-instance="${name}"]`));
  }

  async choose(name: string): Promise<void> {
    await this.row(name).click();
    await expect(this.row(name)).toHaveAttribute('aria-selected', 'true');
  }

  async press(action: string): Promise<void> {
    await this.dialog.getByRole('button', { name: action, exact: true }).click();
  }

  /** Presses a button that asks for a name first. */
  async pressAndName(action: 'Clone…' | 'Rename…', name: string): Promise<void> {
    await this.press(action);
    const asking = this.page.getByRole('dialog', { name: new RegExp(`^${action.slice(0, -1)} `) });
    await asking.getByRole('textbox', { name: 'Name' }).fill(name);
    await asking.getByRole('button', { name: action === 'Clone…' ? 'Create' : 'Rename' }).click();
    await expect(asking).toBeHidden();
  }

  async delete(name: string): Promise<void> {
    await this.choose(name);
    await this.press('Delete…');
    const asking = this.page.getByRole('dialog', { name: `Delete ${name}` });
    await asking.getByRole('button', { name: 'Delete', exact: true }).click();
    await expect(this.row(name)).toHaveCount(0);
  }

  /** The run of the selected instance, as the file that the browser saved. */
  async export(): Promise<string> {
    const saved = this.page.waitForEvent('download');
    await this.press('Export');
    return (await saved).path();
  }

  async import(file: string, name: string): Promise<void> {
    await this.press('Import…');
    const asking = this.page.getByRole('dialog', { name: 'Import a run' });
    await asking.getByLabel('Run file').setInputFiles(file);
    await asking.getByRole('textbox', { name: 'Name' }).fill(name);
    await asking.getByRole('button', { name: 'Import', exact: true }).click();
    await expect(asking).toBeHidden();
  }

  async open(name: string): Promise<void> {
    await this.choose(name);
    await this.press('Open');
    await expect(this.dialog).toBeHidden();
  }
}
